// Tells whether a file is another one than before.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace hearth::viewer
{

/// Version of a file: another one once it is replaced or written to.
struct FileVersion
{
    uint64_t device = 0;
    uint64_t number = 0; ///< on the device
    uint64_t size = 0;
    int64_t seconds = 0; ///< of the last write, with the next
    int64_t nanoseconds = 0;

    friend bool operator==(const FileVersion&, const FileVersion&) = default;
};

/// Return nothing if there is no file.
std::optional<FileVersion> readFileVersion(const std::string& path);

} // namespace hearth::viewer
