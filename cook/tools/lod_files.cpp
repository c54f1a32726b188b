// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/lod_files.h"

#include <algorithm>
#include <charconv>

namespace hearth::tools
{

namespace
{

// Three digits suffice: nobody authors more levels.
constexpr size_t kMaxDigits = 3;
constexpr uint32_t kMaxLevel = 999;

} // namespace

std::optional<LodName> parseLodName(std::string_view name)
{
    size_t digits = 0;
    while (digits < name.size() && name[name.size() - 1 - digits] >= '0' &&
           name[name.size() - 1 - digits] <= '9')
        ++digits;
    constexpr std::string_view kSuffix = "_lod";
    if (digits == 0 || digits > kMaxDigits || name.size() < digits + kSuffix.size())
        return std::nullopt;
    LodName parsed;
    for (const char c : name.substr(0, name.size() - digits))
        parsed.stem += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (!parsed.stem.ends_with(kSuffix))
        return std::nullopt;
    parsed.stem.resize(parsed.stem.size() - kSuffix.size());
    for (const char c : name.substr(name.size() - digits))
        parsed.level = parsed.level * 10 + static_cast<uint32_t>(c - '0');
    return parsed;
}

Result<std::vector<LodFile>> parseLodFiles(std::span<const std::string> options)
{
    std::vector<LodFile> files;
    for (const std::string& option : options)
    {
        const size_t equals = std::min(option.find('='), option.size());
        LodFile file;
        const auto [end, error] = std::from_chars(option.data(), option.data() + equals, file.level);
        if (error != std::errc() || end != option.data() + equals || equals + 1 >= option.size() ||
            file.level < 1 || file.level > kMaxLevel)
            return Error{Issue::usage, "--lod " + option, "",
                         "must be a number from 1 to 999, = and a file, as in --lod 1=rock_low.glb"};
        file.path = option.substr(equals + 1);
        if (std::any_of(files.begin(), files.end(), [&](const LodFile& f) { return f.level == file.level; }))
            return Error{Issue::usage, "--lod " + option, "", "the level is there twice"};
        files.push_back(std::move(file));
    }
    std::sort(files.begin(), files.end(),
              [](const LodFile& a, const LodFile& b) { return a.level < b.level; });
    return files;
}

} // namespace hearth::tools
