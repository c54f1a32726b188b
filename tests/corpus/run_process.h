// Runs one program under time and memory limits, and reports how it ended.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::corpus
{

struct Limits
{
    double seconds = 0;
    uint64_t rss_bytes = 0; ///< sum over the program and its children
};

struct Command
{
    std::vector<std::string> arguments;   ///< [0] is the program's path
    std::vector<std::string> environment; ///< "NAME=value", in addition to this process's environment
    std::string folder;                   ///< existing working folder of the program
    std::string stdout_file;
    std::string stderr_file;
};

struct ProcessEnd
{
    bool started = false;
    int exit_code = 0; ///< valid if it exited by itself
    int signal = 0;    ///< signal that ended it, or 0
    bool over_time = false;
    bool over_memory = false;
    bool left_processes = false; ///< children outlived it; they have been killed
    double seconds = 0;
    uint64_t peak_rss_bytes = 0;
};

/// Make orphans of the programs children of this process, so that none escapes. Call it once, before the
/// first run.
void adoptOrphans();

/// Run `command` in a process group of its own and wait for it; if it exceeds a limit the whole group is
/// killed. Memory is polled as the sum over the group; afterwards it is at least the largest peak of any one
/// process.
ProcessEnd runProcess(const Command& command, const Limits& limits);

} // namespace hearth::corpus
