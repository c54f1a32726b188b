// Runs cookers as child processes, several at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace hearth::tools
{

/// Outcome of a child process, or of one command line of a batch: the first one sent that had not ended yet.
struct ChildOutcome
{
    size_t id = 0;         ///< id from start()
    bool is_alive = false; ///< outcome of a command line; its batch goes on
    int exit_code = 0;     ///< if it exited by itself
    int signal = 0;        ///< signal that ended it, or 0
    std::string messages;  ///< its output to stderr
    double seconds = 0;
    double cpu_seconds = 0;
    uint64_t peak_rss_bytes = 0;
};

/// Child processes of this process. While this object lives, SIGINT, SIGTERM and SIGHUP do not end the
/// process: wait() reports them, so that the caller can clean up. The destructor ends children that still
/// run. Only one such object may exist at a time.
class ChildProcesses
{
public:
    ChildProcesses();
    ~ChildProcesses();
    ChildProcesses(const ChildProcesses&) = delete;
    ChildProcesses& operator=(const ChildProcesses&) = delete;

    /// Start program command[0] with its arguments, without a shell, with stdin and stdout at /dev/null. The
    /// child does not flush its files to the disk (formats/base/flush.h): most of them are deleted before
    /// this process ends. Ids count from 0.
    /// errors: child_failed.
    Result<size_t> start(const std::vector<std::string>& command);

    /// Start a cooker that gets command lines while it runs, see batch.h. wait() reports the end of each
    /// command line, then the end of the process.
    /// errors: child_failed.
    Result<size_t> startBatch(const std::string& program);

    /// Send a command line (from makeBatchLine) to batch `id`, which runs it after the earlier ones. Send
    /// only a few ahead: unread ones fill a buffer of about 100 KB. If the process has died, wait() reports
    /// it.
    void sendCommandLine(size_t id, std::string_view line);

    /// Send no more command lines to batch `id`, which ends after the ones that it has.
    void close(size_t id);

    size_t running() const { return children_.size(); }

    /// Wait until a child, or a command line of a batch, ends; nullopt if a signal asks this process to end.
    /// At least one child must be running.
    /// waiting  called meanwhile, once a second or more often; empty: no call
    std::optional<ChildOutcome> wait(const std::function<void()>& waiting = {});

private:
    struct Child
    {
        size_t id = 0;
        pid_t process = 0;
        /// Pidfd, readable when the process has ended; -1 if the kernel has no pidfds. SIGCHLD would not do:
        /// any thread of this process may take it.
        int pidfd = -1;
        int messages_pipe = -1;
        int work_socket = -1; ///< stdin of a batch that accepts more; else -1
        bool is_batch = false;
        std::chrono::steady_clock::time_point start;
        std::string messages; ///< since the last report
        std::string report;   ///< unfinished report, from its separator on
    };

    Result<size_t> start(const std::vector<std::string>& command, bool is_batch);
    Child* find(size_t id);
    void reap();
    void drain(Child& child);
    void appendOutput(Child& child, std::string_view text);
    void parseReport(Child& child);

    std::vector<Child> children_;
    std::deque<ChildOutcome> outcomes_; ///< not yet reported
    size_t next_id_ = 0;
    sigset_t old_signals_;
    int signal_file_ = -1;
};

/// Return a command line, without the program, in the form that a batch reads; nullopt if JSON cannot
/// represent it: a path need not be UTF-8.
std::optional<std::string> makeBatchLine(std::span<const std::string> arguments);

/// Return the folder of this program, where its cookers lie as well.
std::string programFolder();

} // namespace hearth::tools
