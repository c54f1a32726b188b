// Runs one program under limits of time and memory, and says how it ended.
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
    uint64_t rss_bytes = 0; ///< of the program and its children together
};

struct Command
{
    std::vector<std::string> arguments;   ///< [0] is the program's path
    std::vector<std::string> environment; ///< "NAME=value", in addition to what this process has
    std::string folder;                   ///< the program's working folder; it exists
    std::string stdout_file;
    std::string stderr_file;
};

struct ProcessEnd
{
    bool started = false;
    int exit_code = 0; ///< where it ended by itself
    int signal = 0;    ///< that ended it, or 0
    bool over_time = false;
    bool over_memory = false;
    bool left_processes = false; ///< children outlived it; they have been ended
    double seconds = 0;
    uint64_t peak_rss_bytes = 0;
};

/// Orphans of the programs become children of this process, so that none escapes. Once, before the first run.
void adoptOrphans();

/// Run `command` in a process group of its own and wait for it; past a limit the whole group is killed.
/// Memory: polled as the sum over the group, and the largest peak of any one process afterwards.
ProcessEnd runProcess(const Command& command, const Limits& limits);

} // namespace hearth::corpus
