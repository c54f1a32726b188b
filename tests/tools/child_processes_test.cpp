// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/child_processes.h"

#include "formats/base/flush.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <sys/stat.h>
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

TEST(ChildProcesses, noticeEveryEndWhereOtherThreadsTakeTheSignal)
{
    // SIGCHLD goes to these threads, where a handler discards it
    struct sigaction swallowing
    {
    };
    struct sigaction before
    {
    };
    swallowing.sa_handler = [](int) {};
    ASSERT_EQ(::sigaction(SIGCHLD, &swallowing, &before), 0);
    std::atomic<bool> is_done = false;
    std::vector<std::thread> workers;
    for (int i = 0; i < 2; ++i)
        workers.emplace_back(
            [&]
            {
                while (!is_done)
                    std::this_thread::sleep_for(std::chrono::milliseconds(20));
            });
    constexpr int kChildren = 500;
    const auto from = std::chrono::steady_clock::now();
    {
        ChildProcesses children;
        for (int i = 0; i < kChildren; ++i)
        {
            ASSERT_TRUE(children.start({"/bin/true"}).ok());
            const auto end = children.wait();
            ASSERT_TRUE(end) << "a child's end is no signal to end";
            EXPECT_EQ(end->exit_code, 0);
        }
    }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - from;
    EXPECT_LT(seconds.count(), kChildren * 0.05) << "each end is noticed when it comes";
    is_done = true;
    for (std::thread& worker : workers)
        worker.join();
    ASSERT_EQ(::sigaction(SIGCHLD, &before, nullptr), 0);
}

TEST(ChildProcesses, callWhileTheyWait)
{
    ChildProcesses children;
    ASSERT_TRUE(children.start(shell("sleep 1.5")).ok());
    int calls = 0;
    EXPECT_EQ(children.wait([&] { ++calls; })->exit_code, 0);
    EXPECT_GE(calls, 2) << "after a second, and at the end";
}

TEST(ChildProcesses, waitForAChildThatClosedItsStderr)
{
    ChildProcesses children;
    ASSERT_TRUE(children.start(shell("exec 2>&-; sleep 0.2; exit 7")).ok());
    EXPECT_EQ(children.wait()->exit_code, 7);
}

namespace
{

/// Return a program that runs `script` for each line of a batch.
class BatchScript
{
public:
    explicit BatchScript(const std::string& script)
    {
        std::FILE* file = std::fopen(path.c_str(), "w");
        std::fprintf(file,
                     "#!/bin/sh\n[ \"$1\" = --batch ] || exit 9\nwhile read -r line; do %s\n"
                     "printf '\\036{\"exit\":%%d,\"seconds\":0.5,\"cpu_seconds\":0.25,"
                     "\"peak_rss_bytes\":4096}\\n' $?; done\n",
                     script.c_str());
        std::fclose(file);
        ::chmod(path.c_str(), 0700);
    }
    ~BatchScript() { ::unlink(path.c_str()); }
    std::string path = "batch-script-" + std::to_string(::getpid());
};

} // namespace

TEST(ChildProcesses, leaveFlushingToTheirParent)
{
    ASSERT_EQ(::unsetenv(kFlushEnvironmentVariable), 0);
    EXPECT_FALSE(flushFile(-1));
    ChildProcesses children;
    ASSERT_TRUE(children.start(shell("[ \"$HEARTH_FLUSH\" = off ]")).ok());
    EXPECT_EQ(children.wait()->exit_code, 0);
    ASSERT_EQ(::setenv(kFlushEnvironmentVariable, "off", 1), 0);
    EXPECT_TRUE(flushFile(-1)) << "nothing is asked of the disk";
    ASSERT_EQ(::unsetenv(kFlushEnvironmentVariable), 0);
}

TEST(ChildProcesses, runABatch)
{
    const BatchScript script("echo \"$line\" >&2; [ \"$line\" != bad ]");
    ChildProcesses children;
    const size_t batch = children.startBatch("./" + script.path).value();
    children.sendCommandLine(batch, "good\n");
    children.sendCommandLine(batch, "bad\n");
    for (const char* line : {"good", "bad"})
    {
        const auto end = children.wait();
        ASSERT_TRUE(end);
        EXPECT_EQ(end->id, batch);
        EXPECT_TRUE(end->is_alive);
        EXPECT_EQ(end->messages, line + std::string("\n"));
        EXPECT_EQ(end->exit_code, line == std::string("good") ? 0 : 1);
        EXPECT_EQ(end->seconds, 0.5);
        EXPECT_EQ(end->cpu_seconds, 0.25);
        EXPECT_EQ(end->peak_rss_bytes, 4096u);
    }
    children.sendCommandLine(batch, "later\n");
    EXPECT_EQ(children.wait()->messages, "later\n");
    children.close(batch);
    const auto end = children.wait();
    EXPECT_FALSE(end->is_alive);
    EXPECT_EQ(end->messages, "");
}

TEST(ChildProcesses, tellWhereABatchDies)
{
    const BatchScript script("echo \"$line\" >&2; [ \"$line\" = bad ] && kill -ABRT $$");
    ChildProcesses children;
    const size_t batch = children.startBatch("./" + script.path).value();
    for (const char* line : {"good\n", "bad\n", "good\n"})
        children.sendCommandLine(batch, line);
    EXPECT_TRUE(children.wait()->is_alive);
    const auto end = children.wait();
    EXPECT_FALSE(end->is_alive);
    EXPECT_EQ(end->signal, SIGABRT);
    EXPECT_EQ(end->messages, "bad\n");
    EXPECT_EQ(children.running(), 0u);
}

TEST(ChildProcesses, giveNothingToTheDead)
{
    const BatchScript script("kill -KILL $$");
    ChildProcesses children;
    const size_t batches[] = {children.startBatch("./" + script.path).value(),
                              children.startBatch("./" + script.path).value()};
    for (const size_t batch : batches)
        children.sendCommandLine(batch, "bad\n");
    // both are dead before the end of either is reported
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    ASSERT_EQ(children.wait()->id, batches[0]);
    children.sendCommandLine(batches[1], "late\n");
    children.close(batches[1]);
    EXPECT_EQ(children.wait()->signal, SIGKILL);
    EXPECT_EQ(children.running(), 0u);
}

TEST(ChildProcesses, takeNoiseForMessages)
{
    // the separator that begins an end report, but no report after it; and more output than is kept
    const BatchScript script("if [ $line = noise ]; then printf '\\036noise\\n' >&2; "
                             "else head -c 3000000 /dev/zero >&2; fi");
    ChildProcesses children;
    const size_t batch = children.startBatch("./" + script.path).value();
    children.sendCommandLine(batch, "noise\n");
    EXPECT_EQ(children.wait()->messages, "\x1Enoise\n");
    children.sendCommandLine(batch, "much\n");
    EXPECT_EQ(children.wait()->messages.size(), size_t{1} << 20);
}

TEST(ChildProcesses, sayWhatABatchReads)
{
    const auto line = [](const std::vector<std::string>& words) { return makeBatchLine(words); };
    EXPECT_EQ(line({"a b", "\n\"\\", "\xC3\xA4", ""}), "[\"a b\",\"\\n\\\"\\\\\",\"\xC3\xA4\",\"\"]\n");
    EXPECT_EQ(line({}), "[]\n");
    EXPECT_EQ(line({"Latin-1 \xE4"}), std::nullopt);
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
