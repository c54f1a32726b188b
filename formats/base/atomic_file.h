// Writes a plain file atomically.
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

/// File that is written to a temporary file beside `path`; finish() renames it to `path`. Without finish()
/// nothing appears and the temporary file is removed. errors: cannot_write, naming the path.
class AtomicFile
{
public:
    static Result<AtomicFile> create(const std::string& path);
    AtomicFile(AtomicFile&& other) noexcept = default;
    AtomicFile& operator=(AtomicFile&&) = delete;
    ~AtomicFile();

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    /// Flush to the disk and rename into place; returns the error of any failed write.
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

/// Write a file atomically, or to standard output if `path` is "-". errors: cannot_write; read_failed for
/// standard output
Status writeText(const std::string& path, std::string_view text);

} // namespace hearth
