// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Section S: CSV.
#include <algorithm>

#include "tests/faults/bad_inputs.hpp"
#include "tests/faults/samples.hpp"

namespace verge::faults {
namespace {

std::string replaced(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

std::string utf16(const std::string& text, bool big_endian) {
  std::string out = big_endian ? "\xFE\xFF" : "\xFF\xFE";
  for (const char c : text) out += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
  return out;
}

}  // namespace

std::vector<BadInput> bad_inputs_csv() {
  const std::vector<SamplePoint> points = sample_points(4, 50);
  const std::string table = csv(points, true);
  const std::string with_semicolons = replaced(table, ',', ';');
  const std::string long_line = "1,0,10," + std::string(10U << 20U, '1') + ",2,3\n";
  std::vector<BadInput> all;
  all.push_back({"S01a", "NoHeaderOf6Columns", file("S.csv", csv(points, false)), kGood,
                 "number, level, distance, x, y, z", "", 200, 0});
  all.push_back({"S01b", "NoHeaderOf5Columns", file("S.csv", "1,2,3,4,5\n"), kUnusable,
                 "columns x, y, z are not there", "1:1"});
  all.push_back({"S02a", "DecimalComma", file("S.csv", replaced(with_semicolons, '.', ',')), kUnusable,
                 "decimal comma", "2:5"});
  all.push_back({"S02b", "DecimalCommaBetweenCommas", file("S.csv", "x,y,z\n1,5,2,5,3,5\n"), kUnusable,
                 "more cells", "2:7"});
  all.push_back({"S03a", "QuoteOpen", file("S.csv", "x,y,z\n1,\"2,3\n4,5,6\n"), kUnusable,
                 "quote is not closed", "2:3"});
  all.push_back({"S03b", "QuoteOpenInTheHeader", file("S.csv", "x,y,\"z\n1,2,3\n"), kUnusable,
                 "quote is not closed", "1:5"});
  all.push_back({"S04a", "NulByte", file("S.csv", table + std::string("1,0,2,\0001,2,3\n", 14)), kUnusable,
                 "NUL", "202:7"});
  all.push_back(
      {"S04b", "NulByteFirst", file("S.csv", std::string(1, '\0') + table), kUnusable, "NUL", "1:1"});
  all.push_back({"S05a", "Utf16LittleEndian", file("S.csv", utf16(table, false)), kUnusable, "UTF-16", "0"});
  all.push_back({"S05b", "Utf16BigEndian", file("S.csv", utf16(table, true)), kUnusable, "UTF-16", "0"});
  all.push_back({"S05c", "Utf8Mark", file("S.csv", "\xEF\xBB\xBF" + table), kGood, "", "", 200, 0});
  all.push_back(
      {"S06a", "NumberBeyondDouble", file("S.csv", table + "1,0,2,1e400,2,3\n"), kGood, "", "", 200, 1});
  all.push_back(
      {"S06b", "NumberBeyondFloat", file("S.csv", table + "1,0,2,1e300,2,3\n"), kGood, "", "", 200, 1});
  all.push_back({"S06c", "NumberOf65Digits",
                 file("S.csv", table + "1,0,2," + std::string(65, '1') + ",2,3\n"), kUnusable, "no number",
                 "202:7"});
  all.push_back(
      {"S07a", "LineOf10MiB", file("S.csv", table + long_line), kUnusable, "line is too long", "202:65537"});
  all.push_back(
      {"S07b", "FirstLineOf10MiB", file("S.csv", long_line), kUnusable, "line is too long", "1:65537"});
  all.push_back(
      {"S08a", "RowTooShort", file("S.csv", table + "1,0,2,3,4\n"), kUnusable, "fewer cells", "202:10"});
  all.push_back(
      {"S08b", "RowTooLong", file("S.csv", table + "1,0,2,3,4,5,6\n"), kUnusable, "more cells", "202:13"});
  all.push_back({"S08c", "RowOfOneCell", file("S.csv", table + "end\n"), kUnusable, "no number", "202:1"});
  all.push_back({"S08d", "Columns300",
                 file(
                     "S.csv", "x,y,z" +
                                  [] {
                                    std::string more;
                                    for (int i = 0; i < 297; ++i) more += ",a";
                                    return more;
                                  }() +
                                  "\n1,2,3\n"),
                 kUnusable, "too many columns", "1:513"});
  all.push_back({"S09", "CrOnly", file("S.csv", replaced(table, '\n', '\r')), kGood, "", "", 200, 0});
  return all;
}

}  // namespace verge::faults
