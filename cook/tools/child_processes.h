// Runs the cookers as child processes, several at once.
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

/// How a child ended, or, of a batch, the first of the command lines given to it that had not.
struct ChildEnd
{
    size_t id = 0;         ///< that start() gave
    bool is_alive = false; ///< a batch's process, which goes on
    int exit_code = 0;     ///< where it ended by itself
    int signal = 0;        ///< that ended it, or 0
    std::string messages;  ///< what it wrote to stderr
    double seconds = 0;
    double cpu_seconds = 0;
    uint64_t peak_rss_bytes = 0;
};

/// The children of this process. While it lives, SIGINT, SIGTERM and SIGHUP do not end the process: wait() tells of
/// them, so that the caller can clean up. When it goes, it ends the children that still run. One at a time.
class ChildProcesses
{
public:
    ChildProcesses();
    ~ChildProcesses();
    ChildProcesses(const ChildProcesses&) = delete;
    ChildProcesses& operator=(const ChildProcesses&) = delete;

    /// Start program command[0] with its arguments: no shell, stdin and stdout nowhere. What it writes it does not flush to the
    /// disk (formats/base/flush.h): most of it goes before this process does. Ids count from 0.
    /// errors: child_failed.
    Result<size_t> start(const std::vector<std::string>& command);

    /// Start a cooker that is given command lines while it runs, see batch.h: its end is told of each, then its own.
    /// errors: child_failed.
    Result<size_t> startBatch(const std::string& program);

    /// Give batch `id` a command line (of batchLine): it is run after those before. A few at a time: what a process has not
    /// read fills a buffer of some 100 KB. One that has died says so by wait().
    void give(size_t id, std::string_view line);

    /// Batch `id` is given no more, and ends when it has done what it has.
    void close(size_t id);

    size_t running() const { return children_.size(); }

    /// Wait until a child, or a command line of a batch, ends; nullopt where a signal asks this process to end. At least
    /// one is running.
    /// waiting  is called meanwhile, once a second or more often; empty: is not
    std::optional<ChildEnd> wait(const std::function<void()>& waiting = {});

private:
    struct Child
    {
        size_t id = 0;
        pid_t process = 0;
        /// Is readable when the process has ended; -1 where the kernel has no such files. SIGCHLD would not do: any
        /// thread of this process may take it.
        int end_file = -1;
        int messages_pipe = -1;
        int work_socket = -1; ///< of a batch that may be given more
        bool is_batch = false;
        std::chrono::steady_clock::time_point start;
        std::string messages; ///< since the last end
        std::string report;   ///< of an end: what has come of it, from its separator on
    };

    Result<size_t> start(const std::vector<std::string>& command, bool is_batch);
    Child* find(size_t id);
    void reap();
    void drain(Child& child);
    void take(Child& child, std::string_view text);
    void takeReport(Child& child);

    std::vector<Child> children_;
    std::deque<ChildEnd> ends_; ///< not yet told
    size_t next_id_ = 0;
    sigset_t old_signals_;
    int signal_file_ = -1;
};

/// A command line, without the program, as a batch reads it; nullopt where JSON cannot say it: a path need not be UTF-8.
std::optional<std::string> batchLine(std::span<const std::string> arguments);

/// The folder that this program lies in, where its cookers lie as well.
std::string programFolder();

} // namespace hearth::tools
