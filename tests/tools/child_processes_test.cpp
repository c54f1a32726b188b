// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/child_processes.h"

#include <cerrno>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace hearth::tools
{

namespace
{

std::vector<std::string> shell(const std::string& script)
{
    return {"/bin/sh", "-c", script};
}

} // namespace

TEST(ChildProcesses, tellHowAChildEnded)
{
    ChildProcesses children;
    ASSERT_TRUE(children.start(shell("echo one >&2; echo two >&2; echo hidden; exit 65")).ok());
    const auto end = children.wait();
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exit_code, 65);
    EXPECT_EQ(end->signal, 0);
    EXPECT_EQ(end->messages, "one\ntwo\n");
    EXPECT_GT(end->peak_rss_bytes, 0u);
    EXPECT_EQ(children.running(), 0u);
}

TEST(ChildProcesses, tellWhichSignalEndedAChild)
{
    ChildProcesses children;
    ASSERT_TRUE(children.start(shell("kill -SEGV $$")).ok());
    const auto end = children.wait();
    ASSERT_TRUE(end);
    EXPECT_EQ(end->signal, SIGSEGV);
}

TEST(ChildProcesses, takeMoreMessagesThanAPipeHolds)
{
    ChildProcesses children;
    ASSERT_TRUE(children.start(shell("head -c 300000 /dev/zero | tr '\\0' x >&2; exit 3")).ok());
    const auto end = children.wait();
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exit_code, 3);
    EXPECT_EQ(end->messages.size(), 300000u);
}

TEST(ChildProcesses, forgetEndlessMessages)
{
    ChildProcesses children;
    ASSERT_TRUE(children.start(shell("head -c 3000000 /dev/zero >&2")).ok());
    const auto end = children.wait();
    ASSERT_TRUE(end);
    EXPECT_EQ(end->exit_code, 0);
    EXPECT_EQ(end->messages.size(), size_t{1} << 20);
}

TEST(ChildProcesses, runSeveralAtOnce)
{
    ChildProcesses children;
    const size_t slow = children.start(shell("sleep 0.5")).value();
    const size_t quick = children.start(shell("true")).value();
    EXPECT_EQ(children.running(), 2u);
    EXPECT_EQ(children.wait()->id, quick);
    EXPECT_EQ(children.wait()->id, slow);
}

TEST(ChildProcesses, waitForAChildThatClosedItsStderr)
{
    ChildProcesses children;
    ASSERT_TRUE(children.start(shell("exec 2>&-; sleep 0.2; exit 7")).ok());
    EXPECT_EQ(children.wait()->exit_code, 7);
}

TEST(ChildProcesses, sayWhatCannotBeStarted)
{
    ChildProcesses children;
    const auto started = children.start({"/nowhere/hearth-import", "x"});
    ASSERT_FALSE(started.ok());
    EXPECT_EQ(started.error().issue, Issue::child_failed);
    EXPECT_EQ(started.error().file, "/nowhere/hearth-import");
}

TEST(ChildProcesses, tellOfSignalsInsteadOfDying)
{
    ChildProcesses children;
    ASSERT_TRUE(children.start(shell("exec sleep 60")).ok());
    std::thread([] { ::kill(::getpid(), SIGINT); }).join();
    EXPECT_FALSE(children.wait());
}

TEST(ChildProcesses, endWithTheirOwner)
{
    {
        ChildProcesses children;
        ASSERT_TRUE(children.start(shell("exec sleep 60")).ok());
    }
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
}

TEST(ChildProcesses, leaveSignalsOfAChildAsTheyWere)
{
    ChildProcesses children;
    // a child that could not be interrupted would run for its whole minute
    ASSERT_TRUE(children.start(shell("kill -INT $$; exec sleep 60")).ok());
    EXPECT_EQ(children.wait()->signal, SIGINT);
}

} // namespace hearth::tools
