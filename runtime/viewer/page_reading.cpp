// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/page_reading.h"

#include "runtime/viewer/command_line.h"

namespace hearth::viewer
{

bool readPage(const formats::PackView& pack, uint32_t page, std::span<std::byte> destination)
{
    const Status read = pack.decodePage(page, destination);
    if (!read.ok())
        printError({Issue::degraded, pack.name(), "page " + std::to_string(page),
                    "cannot be read, what it refines stays coarse: " + formatMessage(read.error())});
    return read.ok();
}

} // namespace hearth::viewer
