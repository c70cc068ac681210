/// @file A folder for a test, and the program run in it.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "cli/process.h"
#include "temporary_folder.h"

namespace cairn::test {

class CommandLine : public ::testing::Test {
  protected:
    const std::filesystem::path& folder() const { return folder_.path(); }
    std::filesystem::path file(const std::string& name) const { return folder_ / name; }
    Finished cairn(const std::vector<std::string>& arguments) const { return runProgram(folder(), arguments); }

    /// Expects the exit code for wrong use, a message with these parts, and nothing else printed.
    void expectWrongUse(const std::vector<std::string>& arguments, const std::vector<std::string>& parts) const {
        const Finished done = cairn(arguments);
        EXPECT_EQ(done.code, 2) << done.error;
        EXPECT_EQ(done.out, "");
        EXPECT_TRUE(done.error.starts_with("cairn: error: ")) << done.error;
        for (const std::string& part : parts) {
            EXPECT_NE(done.error.find(part), std::string::npos) << part << " is not in: " << done.error;
        }
    }

    std::string read(const std::string& name) const {
        std::ifstream in(file(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(file(name)) << text; }

  private:
    TemporaryFolder folder_;
};

}  // namespace cairn::test
