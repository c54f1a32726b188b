// List of the files that a program has read, as hearth-import --depfile writes it.
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

/// Files by path, each with the SHA-256 of the content that was read; nullopt for a file that was probed and
/// could not be read.
///
/// The text form has a line per file, as sha256sum writes it: hash, two blanks, path; 64 times '-' for an
/// absent file. A line whose path has a backslash or a line break starts with a backslash and escapes them as
/// \\ and \n.
class DependencyList
{
public:
    void add(const std::string& path, std::span<const std::byte> content);
    void addFile(const std::string& path);
    void addAbsent(const std::string& path);

    const std::map<std::string, std::optional<std::string>>& files() const { return files_; }

    std::string text() const;
    /// Parse the text form; nullopt if the text is malformed.
    static std::optional<DependencyList> parse(std::string_view text);

private:
    void addEntry(const std::string& path, std::optional<std::string> hash);

    std::map<std::string, std::optional<std::string>> files_;
};

} // namespace hearth::tools
