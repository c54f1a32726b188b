// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/program.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{

using namespace hearth;

TEST(Program, endsWithTheCodeOfItsBody)
{
    EXPECT_EQ(runProgram("tool", [] { return 65; }), 65);
}

TEST(Program, E4005_runsOutOfMemory)
{
    testing::internal::CaptureStderr();
    EXPECT_EQ(runProgram("tool", []() -> int { throw std::bad_alloc(); }), 70);
    const std::string message = testing::internal::GetCapturedStderr();
    EXPECT_NE(message.find("tool: error: the machine has not enough memory"), std::string::npos) << message;
    EXPECT_NE(message.find("[E4005]"), std::string::npos) << message;
}

TEST(Program, E7000_saysWhatWasThrown)
{
    testing::internal::CaptureStderr();
    EXPECT_EQ(runProgram("tool", []() -> int { throw std::runtime_error("a library gave up"); }), 70);
    const std::string message = testing::internal::GetCapturedStderr();
    EXPECT_NE(message.find("a library gave up"), std::string::npos) << message;
    EXPECT_NE(message.find("[E7000]"), std::string::npos) << message;
}

} // namespace
