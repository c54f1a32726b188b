// What a program has read: the list that hearth-import --depfile writes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hearth::tools
{

/// Files by path, each with the SHA-256 of what was read; nullopt for one that was looked for and could not be read.
///
/// As text a line a file, as sha256sum writes it: hash, two blanks, path; 64 times '-' for a file that was not there;
/// a line whose path has a backslash or a line break starts with a backslash and has them as \\ and \n.
class ReadList
{
public:
    void add(const std::string& path, std::span<const std::byte> content);
    void addFile(const std::string& path);
    void addAbsent(const std::string& path);

    const std::map<std::string, std::optional<std::string>>& files() const { return files_; }

    std::string text() const;
    /// nullopt where the text is not of that form
    static std::optional<ReadList> parse(std::string_view text);

private:
    void note(const std::string& path, std::optional<std::string> hash);

    std::map<std::string, std::optional<std::string>> files_;
};

} // namespace hearth::tools
