// Flushes files to the disk, unless flushing is turned off.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdlib>
#include <string_view>
#include <unistd.h>

namespace hearth
{

/// Environment variable of child processes. Value "off": the parent process flushes the outputs that it
/// keeps.
inline constexpr const char* kFlushEnvironmentVariable = "HEARTH_FLUSH";

/// Wait until the open file is on the disk, so that after a power failure a file has its name and its content
/// or neither. Does nothing if kFlushEnvironmentVariable is "off". Returns false on failure, with errno set.
inline bool flushFile(int file)
{
    const char* wanted = std::getenv(kFlushEnvironmentVariable);
    return (wanted != nullptr && std::string_view(wanted) == "off") || ::fsync(file) == 0;
}

} // namespace hearth
