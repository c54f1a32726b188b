// Writes a plain file whole or not at all.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace hearth
{

/// Collects bytes in a temporary file beside `path`; finish() makes it appear under `path`. Without finish() nothing
/// appears and the temporary file is removed. errors: cannot_write, naming the path.
class AtomicFile
{
public:
    static Result<AtomicFile> create(const std::string& path);
    AtomicFile(AtomicFile&& other) noexcept = default;
    AtomicFile& operator=(AtomicFile&&) = delete;
    ~AtomicFile();

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    /// Flush to the disk and rename into place; tells of any write that failed.
    Status finish();

private:
    AtomicFile(std::string path, std::string temporary_path, std::FILE* file);

    struct Close
    {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::string path_;
    std::string temporary_path_;
    std::unique_ptr<std::FILE, Close> file_;
    bool failed_ = false;
};

/// Write a file whole, or to standard output where `path` is "-". errors: cannot_write; read_failed for standard output
Status writeText(const std::string& path, std::string_view text);

} // namespace hearth
