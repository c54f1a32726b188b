// Runs the cookers as child processes, several at once.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace hearth::tools
{

/// How a child ended.
struct ChildEnd
{
    size_t id = 0;        ///< that start() gave
    int exit_code = 0;    ///< where it ended by itself
    int signal = 0;       ///< that ended it, or 0
    std::string messages; ///< what it wrote to stderr
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

    /// Start program command[0] with its arguments: no shell, stdin and stdout nowhere. Ids count from 0.
    /// errors: child_failed.
    Result<size_t> start(const std::vector<std::string>& command);

    size_t running() const { return children_.size(); }

    /// Wait until a child ends; nullopt where a signal asks this process to end. At least one is running.
    std::optional<ChildEnd> wait();

private:
    struct Child
    {
        size_t id = 0;
        pid_t process = 0;
        int messages_pipe = -1;
        std::chrono::steady_clock::time_point start;
        std::string messages;
    };

    std::optional<ChildEnd> reapOne();
    static void drain(Child& child);

    std::vector<Child> children_;
    size_t next_id_ = 0;
    sigset_t old_signals_;
    int signal_file_ = -1;
};

/// The folder that this program lies in, where its cookers lie as well.
std::string programFolder();

} // namespace hearth::tools
