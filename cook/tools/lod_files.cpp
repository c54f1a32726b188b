// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/lod_files.h"

#include <algorithm>
#include <charconv>

namespace hearth::tools
{

namespace
{

// More levels than anybody makes by hand.
constexpr uint32_t kMaxLevel = 64;

} // namespace

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
                         "must be a number from 1 to 64, = and a file, as in --lod 1=rock_low.glb"};
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
