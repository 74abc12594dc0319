// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0
#include "verge/io/file/point_cloud2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "verge/io/file/columns.hpp"
#include "verge/io/file/point_table.hpp"

namespace verge::io {
namespace {

/// PointField's numbers of the types, 1 to 8.
constexpr std::array<Scalar, 8> kTypes{Scalar::kI8,  Scalar::kU8,  Scalar::kI16, Scalar::kU16,
                                       Scalar::kI32, Scalar::kU32, Scalar::kF32, Scalar::kF64};

std::uint8_t datatype_of(Scalar type) {
  return static_cast<std::uint8_t>(std::find(kTypes.begin(), kTypes.end(), type) - kTypes.begin() + 1);
}

bool has_type(const PointField& field) { return field.datatype >= 1 && field.datatype <= kTypes.size(); }
Scalar type_of(const PointField& field) { return kTypes[field.datatype - 1U]; }

/// Old drivers leave the count 0 where there is one value.
std::uint64_t values_in(const PointField& field) { return std::max<std::uint64_t>(field.count, 1); }

/// A field, and a fault where it does not lie inside a point; the point's size comes later in the message.
struct FieldAt {
  PointField field;
  std::size_t offset = 0;  // in the message
};

FieldAt read_field(MessageReader& reader) {
  FieldAt out;
  out.offset = reader.offset();
  out.field.name = reader.text();
  out.field.offset = reader.number<std::uint32_t>();
  out.field.datatype = reader.number<std::uint8_t>();
  out.field.count = reader.number<std::uint32_t>();
  return out;
}

void check_field(MessageReader& reader, const FieldAt& at, std::uint32_t point_step) {
  const PointField& field = at.field;
  if (!has_type(field)) {
    reader.fail(at.offset, "field has no known type", fmt::format("{}", field.datatype), "1..8");
    return;
  }
  const std::uint64_t end = field.offset + values_in(field) * size_of(type_of(field));  // < 2^36
  if (end > point_step) {
    reader.fail(at.offset, "field lies outside its point", fmt::format("{} B", end),
                fmt::format("<= {} B", point_step));
  }
}

void check_steps(MessageReader& reader, const PointCloud2& cloud, std::size_t at) {
  if (cloud.points() == 0) return;
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.point_step == 0 || cloud.row_step < row) {
    reader.fail(at, "rows are shorter than their points",
                fmt::format("{} B for {} x {} B", cloud.row_step, cloud.width, cloud.point_step),
                fmt::format(">= {} B", std::max<std::uint64_t>(row, 1)));
    return;
  }
  const std::uint64_t need = std::uint64_t{cloud.height - 1} * cloud.row_step + row;
  if (need > cloud.data.size()) {
    reader.fail(at, "cloud is larger than its data", fmt::format("{} B", cloud.data.size()),
                fmt::format(">= {} B", need));
  }
}

RoleFields roles_of(const PointCloud2& cloud) {
  std::vector<std::string> names;
  for (const PointField& field : cloud.fields) names.push_back(field.name);
  return assign_roles(names);
}

bool has_role(const RoleFields& roles, Role role) {
  return roles[static_cast<std::size_t>(role)].has_value();
}

/// Rows one right behind the other: the data themselves, or a copy in `buffer` without what pads them.
Bytes packed_rows(const PointCloud2& cloud, std::vector<std::byte>& buffer) {
  const std::size_t row = std::size_t{cloud.width} * cloud.point_step;
  if (cloud.row_step == row || cloud.height == 1) return cloud.data.first(row * cloud.height);
  buffer.reserve(row * cloud.height);
  for (std::size_t r = 0; r < cloud.height; ++r) {
    const Bytes bytes = cloud.data.subspan(r * cloud.row_step, row);
    buffer.insert(buffer.end(), bytes.begin(), bytes.end());
  }
  return buffer;
}

/// Rings of an organised cloud without a ring field: its rows or, where they are fewer, its columns.
void set_rings_by_grid(const PointCloud2& cloud, Decoded& out) {
  constexpr std::uint32_t kMostRings = 256;
  const std::uint32_t rings = std::min(cloud.height, cloud.width);
  if (rings < 2 || rings > kMostRings) return;
  const bool by_row = cloud.height == rings;
  out.cloud.ring.resize(out.cloud.x.size());
  for (std::size_t i = 0; i < out.cloud.ring.size(); ++i) {
    out.cloud.ring[i] = static_cast<std::int64_t>(by_row ? i / cloud.width : i % cloud.width);
  }
  out.notes.emplace_back(by_row ? "rings are the rows of the cloud" : "rings are the columns of the cloud");
}

bool is_finite(const Cloud& cloud, std::size_t i) {
  return std::isfinite(cloud.x[i]) && std::isfinite(cloud.y[i]) && std::isfinite(cloud.z[i]);
}

/// The earliest time of a point that can be used, 0 where there is none.
double earliest_time(const Cloud& cloud) {
  double earliest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cloud.time_s.size(); ++i) {
    if (is_finite(cloud, i)) earliest = std::min(earliest, cloud.time_s[i]);
  }
  return std::isfinite(earliest) ? earliest : 0.0;
}

/// Times count from the header's stamp, which drivers set at the beginning or the end of a scan, or from an
/// absolute time of their own: make them count from the first point.
void set_stamp(const RosHeader& header, Decoded& out) {
  constexpr double kLongest_s = 3600.0;  // a time farther off says nothing about a scan
  if (!out.stamp_ns && header.stamp_ns != 0) out.stamp_ns = header.stamp_ns;
  const double earliest = earliest_time(out.cloud);
  if (earliest == 0.0 || std::fabs(earliest) > kLongest_s) return;
  for (double& time : out.cloud.time_s) time -= earliest;
  if (out.stamp_ns) *out.stamp_ns += std::llround(earliest * 1e9);
}

Decoded fill_columns(const PointCloud2& cloud, const RoleFields& roles) {
  std::vector<std::byte> buffer;
  const Bytes data = packed_rows(cloud, buffer);
  CloudBuilder builder(static_cast<std::size_t>(cloud.points()));
  for (std::size_t role = 0; role < kRoles; ++role) {
    if (!roles[role]) continue;
    const PointField& field = cloud.fields[*roles[role]];
    builder.add(static_cast<Role>(role), {.bytes = data,
                                          .offset = field.offset,
                                          .stride = cloud.point_step,
                                          .type = type_of(field),
                                          .big_endian = cloud.big_endian});
  }
  return std::move(builder).take();
}

Error no_cloud(std::string what, std::string got = {}, std::string need = {}) {
  return {ErrorCode::kDamaged, {}, "0", std::move(what), std::move(got), std::move(need)};
}

/// Fields of what we write, one right behind the other.
std::vector<PointField> fields_of(const std::vector<TableColumn>& table) {
  std::vector<PointField> fields;
  std::uint32_t offset = 0;
  for (const TableColumn& column : table) {
    fields.push_back({std::string(column.name), offset, datatype_of(type_of(column)), 1});
    offset += static_cast<std::uint32_t>(size_of(type_of(column)));
  }
  return fields;
}

void write_fields(CdrWriter& writer, const std::vector<PointField>& fields) {
  writer.number(static_cast<std::uint32_t>(fields.size()));
  for (const PointField& field : fields) {
    writer.text(field.name);
    writer.number(field.offset);
    writer.number(field.datatype);
    writer.number(field.count);
  }
}

}  // namespace

Expected<PointCloud2> read_point_cloud2(Wire wire, Bytes message) {
  constexpr std::size_t kLeastField = 4 + 4 + 1 + 4;
  MessageReader reader(wire, message);
  PointCloud2 out;
  out.header = read_header(reader);
  out.height = reader.number<std::uint32_t>();
  const std::size_t at = reader.offset();
  out.width = reader.number<std::uint32_t>();
  std::vector<FieldAt> fields;
  for (std::uint32_t n = reader.count(kLeastField); n > 0 && !reader.fault(); --n) {
    fields.push_back(read_field(reader));
  }
  out.big_endian = reader.number<std::uint8_t>() != 0;
  out.point_step = reader.number<std::uint32_t>();
  out.row_step = reader.number<std::uint32_t>();
  out.data = reader.bytes(reader.count(1));
  for (const FieldAt& field : fields) check_field(reader, field, out.point_step);
  check_steps(reader, out, at);
  if (reader.fault()) return Unexpected(*reader.fault());
  for (FieldAt& field : fields) out.fields.push_back(std::move(field.field));
  return out;
}

Expected<Decoded> decode_point_cloud2(const PointCloud2& cloud) {
  if (cloud.points() == 0) return Unexpected(no_cloud("cloud has 0 points"));
  const RoleFields roles = roles_of(cloud);
  if (!has_role(roles, Role::kX) || !has_role(roles, Role::kY) || !has_role(roles, Role::kZ)) {
    std::string names;
    for (const PointField& field : cloud.fields) names += (names.empty() ? "" : " ") + field.name;
    return Unexpected(no_cloud("cloud lacks a coordinate", names, "x y z"));
  }
  Decoded out = fill_columns(cloud, roles);
  if (!has_role(roles, Role::kRing)) set_rings_by_grid(cloud, out);
  set_stamp(cloud.header, out);
  out.frame_id = cloud.header.frame_id;
  return out;
}

std::string write_point_cloud2(const Scan& scan) {
  const std::vector<TableColumn> table = point_table(scan, TableTime::kOffset);
  const std::vector<PointField> fields = fields_of(table);
  const auto width = static_cast<std::uint32_t>(scan.size());
  const std::uint32_t step =
      fields.back().offset + static_cast<std::uint32_t>(size_of(type_of(table.back())));
  std::string points;
  points.reserve(std::size_t{width} * step);
  for (std::size_t row = 0; row < width; ++row) append_bytes(table, row, points);
  CdrWriter writer;
  write_header(writer, {scan.stamp_ns.value_or(0), scan.frame_id});
  writer.number(std::uint32_t{1});
  writer.number(width);
  write_fields(writer, fields);
  writer.number(std::uint8_t{0});
  writer.number(step);
  writer.number(step * width);
  writer.bytes(points);
  writer.number(std::uint8_t{1});
  return std::move(writer).take();
}

}  // namespace verge::io
