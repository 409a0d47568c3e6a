#pragma once

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

namespace deformlab::test {

using Words = std::vector<std::string>;

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What one start of the program did.
struct Ending {
  int status = -1;  ///< its exit status, or minus the signal that ended it (SIGALRM: it hung)
  std::string out, err;
};

/// Starts a program in `folder`, with its output in two files, and does not wait for its end. A run
/// of over two minutes is a hang, which a signal ends.
inline pid_t begin_program(const std::filesystem::path& folder, Words arguments,
                           const std::string& out = "/dev/null",
                           const std::string& err = "/dev/null",
                           const std::string& program = DEFORMLAB_PROGRAM_PATH) {
  constexpr unsigned kMostSeconds = 120;
  arguments.insert(arguments.begin(), program);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    const bool ready = chdir(folder.c_str()) == 0 && dup2(open(out.c_str(), flags, 0600), 1) == 1 &&
                       dup2(open(err.c_str(), flags, 0600), 2) == 2;
    alarm(kMostSeconds);  // outlives execv
    if (ready) execv(argv[0], argv.data());
    _exit(127);
  }
  return child;
}

/// Starts deformlab in `folder` and waits for its end.
inline Ending start_program(const std::filesystem::path& folder, const Words& arguments,
                            const std::string& program = DEFORMLAB_PROGRAM_PATH) {
  const std::string out = folder.string() + ".stdout", err = folder.string() + ".stderr";
  const pid_t child = begin_program(folder, arguments, out, err, program);
  int status = 0;
  waitpid(child, &status, 0);
  Ending ending{WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), read_file(out),
                read_file(err)};
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return ending;
}

/// A test that runs the program in an empty folder of its own.
class Program : public ::testing::Test {
 protected:
  Program() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    for (char& c : name) c = c == '/' ? '_' : c;
    folder_ = std::filesystem::path(::testing::TempDir()) / ("deformlab_" + name);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~Program() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path place(const std::string& name) const { return folder_ / name; }

  void put(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories(place(name).parent_path());
    std::ofstream(place(name), std::ios::binary) << bytes;
  }

  std::string get(const std::string& name) const { return read_file(place(name)); }

  bool exists(const std::string& name) const { return std::filesystem::exists(place(name)); }

  Ending start(const Words& arguments) const { return start_program(folder_, arguments); }

  /// All that lies below the folder: relative path and bytes.
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> result;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      const std::string name = entry.path().lexically_relative(folder_).string();
      result[name] = entry.is_directory() ? "folder" : read_file(entry.path());
    }
    return result;
  }

  /// Names of what appeared, vanished or changed since.
  Words changes_since(const std::map<std::string, std::string>& before) const {
    const auto now = contents();
    Words names;
    for (const auto& [name, bytes] : now) {
      const auto old = before.find(name);
      if (old == before.end() || old->second != bytes) names.push_back(name);
    }
    for (const auto& [name, bytes] : before) {
      if (!now.contains(name)) names.push_back(name);
    }
    return names;
  }

  /// The program ends well.
  Ending expect_success(const Words& arguments) const {
    Ending ending = start(arguments);
    EXPECT_EQ(ending.status, 0) << ending.err;
    EXPECT_EQ(ending.out.find("nan"), std::string::npos) << ending.out;
    return ending;
  }

  /// The program refuses with status 2 and a message of one line that holds all these words; every
  /// file stays as it was and none appears.
  void expect_refused(const Words& arguments, const Words& words) const {
    const auto before = contents();
    const Ending ending = start(arguments);
    EXPECT_EQ(ending.status, 2) << ending.out << ending.err;
    const std::size_t begin = ending.err.find("deformlab: ");
    ASSERT_NE(begin, std::string::npos) << ending.err;
    const std::string message = ending.err.substr(begin);
    EXPECT_EQ(message.find('\n'), message.size() - 1) << message;
    for (const std::string& word : words) EXPECT_THAT(message, ::testing::HasSubstr(word));
    EXPECT_THAT(changes_since(before), ::testing::IsEmpty()) << message;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace deformlab::test
