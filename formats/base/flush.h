// Onto the disk, where that is asked for.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdlib>
#include <string_view>
#include <unistd.h>

namespace hearth
{

/// Says to a program, with value "off", that whoever started it flushes what it keeps of its outputs.
inline constexpr const char* kFlushVariable = "HEARTH_FLUSH";

/// Wait until the open file is on the disk, so that a file has its name and its content or neither, even where the power
/// fails; done at once where kFlushVariable says so. false: errno says why not.
inline bool flushFile(int file)
{
    const char* wanted = std::getenv(kFlushVariable);
    return (wanted != nullptr && std::string_view(wanted) == "off") || ::fsync(file) == 0;
}

} // namespace hearth
