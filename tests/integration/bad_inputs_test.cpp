// SPDX-FileCopyrightText: The verge authors
// SPDX-License-Identifier: Apache-2.0

// Every bad input of the catalogue through the real program: its exit code, and one line that says what and
// where.
#include "tests/faults/bad_inputs.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace verge::faults {

void PrintTo(const BadInput& input, std::ostream* out) { *out << input.code << " " << input.title; }

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr uid_t kNobody = 65534;

struct Ended {
  int code = -1;  ///< 128 + signal where one killed it.
  std::string out;
  std::string err;
};

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void redirect(int fd, const fs::path& file) {
  const int to = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (to < 0 || ::dup2(to, fd) < 0) ::_exit(120);
}

/// Runs the program to its end; as nobody where a superuser's rights would prove nothing.
Ended run_program(const std::vector<std::string>& arguments, const fs::path& folder, bool as_nobody) {
  std::vector<char*> argv;
  static const std::string program = VERGE_PROGRAM;
  argv.push_back(const_cast<char*>(program.c_str()));
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    redirect(STDOUT_FILENO, folder / "stdout");
    redirect(STDERR_FILENO, folder / "stderr");
    if (as_nobody && ::geteuid() == 0 && ::setuid(kNobody) != 0) ::_exit(121);
    ::execv(program.c_str(), argv.data());
    ::_exit(122);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), content(folder / "stdout"),
          content(folder / "stderr")};
}

std::vector<std::string> lines_with(const std::string& text, const std::string& start) {
  std::vector<std::string> found;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(start)) found.push_back(line);
  }
  return found;
}

/// As somebody else judges it: the library refuses to write other texts.
bool is_utf8(const std::string& text) {
  try {
    static_cast<void>(nlohmann::json(text).dump());
    return true;
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

class BadInputs : public ::testing::TestWithParam<BadInput> {
 protected:
  void SetUp() override {
    folder_ = fs::path(::testing::TempDir()) / ("verge_bad_" + GetParam().code);
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "input");
    fs::permissions(folder_, fs::perms(0755));
    path_ = GetParam().make(folder_ / "input");
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] Ended run(const std::vector<std::string>& verb) const {
    std::vector<std::string> arguments = verb;
    arguments.push_back(path_.string());
    if (!GetParam().format.empty()) arguments.insert(arguments.end(), {"--format", GetParam().format});
    if (GetParam().memory_mib > 0) {
      arguments.insert(arguments.end(), {"--max-mem", std::to_string(GetParam().memory_mib)});
    }
    const auto add = [&](const char* option, const std::string& value) {
      if (!value.empty()) arguments.insert(arguments.end(), {option, value});
    };
    add("--sensor-ip", GetParam().sensor_ip);
    add("--model", GetParam().model);
    if (!GetParam().calibration.empty()) {
      add("--calibration", (path_.parent_path() / GetParam().calibration).string());
    }
    return run_program(arguments, folder_, GetParam().as_user);
  }

  fs::path folder_;
  fs::path path_;
};

TEST_P(BadInputs, EndAsTheContractSays) {
  const BadInput& input = GetParam();
  std::vector<std::vector<std::string>> verbs{{"detect"}, {"info"}};
  if (input.exit == kGood || input.exit == kDamaged)
    verbs.push_back({"info", "--json"});  // else it says nothing
  for (const auto& verb : verbs) {
    const Ended ended = run(verb);
    EXPECT_EQ(ended.code, static_cast<int>(input.exit)) << verb.front() << "\n" << ended.err;
    EXPECT_TRUE(is_utf8(ended.err) && is_utf8(ended.out)) << ended.err;
    if (verb.back() == "--json" && !ended.out.empty()) {
      EXPECT_TRUE(nlohmann::json::accept(ended.out)) << ended.out;
    }
    const auto errors = lines_with(ended.err, "verge: error: ");
    const std::size_t warnings = lines_with(ended.err, "verge: warning: ").size();
    // What info has to say of the recording stands in its table.
    EXPECT_THAT(verb.front() == "info" ? ended.out : ended.err, HasSubstr(input.warns));
    if (input.exit == kGood) {
      EXPECT_TRUE(errors.empty()) << ended.err;
      EXPECT_FALSE(ended.out.empty());
      continue;
    }
    ASSERT_EQ(errors.size(), input.errors) << ended.err;
    EXPECT_LE(errors[0].size(), 300U);
    EXPECT_THAT(errors[0], HasSubstr(input.says));
    if (!input.where.empty()) {
      EXPECT_THAT(errors[0], HasSubstr(":" + input.where + ": "));
    }
    if (input.exit != kDamaged) {
      EXPECT_EQ(ended.out, "");
    } else {
      EXPECT_EQ(warnings, input.warns.empty() || verb.front() == "info" ? 1U : 2U) << ended.err;
    }
    EXPECT_TRUE(std::all_of(ended.err.begin(), ended.err.end(),
                            [](char c) { return c == '\n' || c >= ' ' || c < 0; }))
        << "control bytes reach the terminal: " << ended.err;
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, BadInputs, ::testing::ValuesIn(bad_inputs()),
                         [](const auto& tested) { return tested.param.code + "_" + tested.param.title; });

}  // namespace
}  // namespace verge::faults
