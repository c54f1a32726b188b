// Reads the bytes of an imported file, or maps them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <sys/stat.h>
#include <vector>

namespace hearth::import
{

/// Content of a file: a copy in memory, or for a large file a memory mapping, of which only accessed pages
/// are in memory. A scene of gigabytes is imported mesh by mesh.
class FileBytes
{
public:
    /// Read a regular file of at most `max_bytes`; devices, pipes and folders are refused without being read.
    /// errors: input_missing, input_too_large, read_failed.
    static Result<FileBytes> read(const std::string& path, uint64_t max_bytes);

    explicit FileBytes(std::vector<std::byte> bytes) : owned_(std::move(bytes)) {}
    FileBytes(FileBytes&& other) noexcept;
    FileBytes& operator=(FileBytes&&) = delete;
    ~FileBytes();

    std::span<const std::byte> bytes() const { return mapped_.empty() ? std::span(owned_) : mapped_; }

    /// Return the XXH3-64, as formats::hashBytes, with one piece at a time in memory.
    uint64_t hash() const;

    bool isMapped() const { return !mapped_.empty(); }

    /// Drop the pages of a mapping from this process's memory until they are accessed again.
    void releasePages() const;

    /// Check that the file of a mapping has not changed since it was mapped. errors: read_failed.
    Status checkUnchanged() const;

private:
    std::vector<std::byte> owned_;
    std::span<const std::byte> mapped_;
    std::string path_; ///< of a mapping
    struct stat stat_at_open_ = {};
};

} // namespace hearth::import
