// The bytes of a file that is imported.
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

/// In memory; of a large file a mapping, of which only what is looked at is in memory: a scene of gigabytes is imported mesh
/// by mesh.
class FileBytes
{
public:
    /// The content of a regular file of at most `max_bytes`; devices, pipes and folders are refused without being read.
    /// errors: input_missing, input_too_large, read_failed.
    static Result<FileBytes> read(const std::string& path, uint64_t max_bytes);

    explicit FileBytes(std::vector<std::byte> bytes) : owned_(std::move(bytes)) {}
    FileBytes(FileBytes&& other) noexcept;
    FileBytes& operator=(FileBytes&&) = delete;
    ~FileBytes();

    std::span<const std::byte> bytes() const { return mapped_.empty() ? std::span(owned_) : mapped_; }

    /// XXH3-64 as formats::hashBytes, with a piece at a time in memory.
    uint64_t hash() const;

    bool isMapping() const { return !mapped_.empty(); }

    /// A mapping's bytes leave this process's memory until they are looked at again.
    void forget() const;

    /// errors: read_failed where the file of a mapping is not what it was when it was mapped.
    Status unchanged() const;

private:
    std::vector<std::byte> owned_;
    std::span<const std::byte> mapped_;
    std::string path_; ///< of a mapping
    struct stat then_ = {};
};

} // namespace hearth::import
