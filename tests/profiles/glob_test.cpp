// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/glob.h"

#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

namespace hearth::profiles
{

namespace
{

using Names = std::vector<std::string>;

// Reference matcher: tries every possibility.

bool matchesName(std::string_view pattern, std::string_view name)
{
    if (pattern.empty())
        return name.empty();
    if (pattern[0] == '*')
        return matchesName(pattern.substr(1), name) ||
               (!name.empty() && matchesName(pattern, name.substr(1)));
    return !name.empty() && (pattern[0] == '?' || pattern[0] == name[0]) &&
           matchesName(pattern.substr(1), name.substr(1));
}

bool matchesNames(const Names& pattern, const Names& names, size_t p = 0, size_t n = 0)
{
    if (p == pattern.size())
        return n == names.size();
    if (pattern[p] != "**")
        return n < names.size() && matchesName(pattern[p], names[n]) &&
               matchesNames(pattern, names, p + 1, n + 1);
    for (size_t end = n; end <= names.size(); ++end)
        if (matchesNames(pattern, names, p + 1, end))
            return true;
    return false;
}

std::string joined(const Names& names)
{
    std::string path;
    for (const std::string& name : names)
        path += (path.empty() ? "" : "/") + name;
    return path;
}

} // namespace

TEST(MatchesPath, knowsFoldersAndNames)
{
    for (const char* path : {"props/a.glb", "props/x/a.glb", "props/x/y/a.glb"})
        EXPECT_TRUE(matchesPath("props/**/*.glb", path)) << path;
    for (const char* path : {"a.glb", "prop/a.glb", "props/a.gltf", "x/props/a.glb", "props/a.glb/b"})
        EXPECT_FALSE(matchesPath("props/**/*.glb", path)) << path;
    EXPECT_TRUE(matchesPath("*.glb", "a.glb"));
    EXPECT_FALSE(matchesPath("*.glb", "x/a.glb"));
    EXPECT_TRUE(matchesPath("**", "x/y/a.glb"));
    EXPECT_TRUE(matchesPath("x/**", "x/y/a.glb"));
    EXPECT_TRUE(matchesPath("**/y/**/?.glb", "y/a.glb"));
    EXPECT_FALSE(matchesPath("**/y/**/?.glb", "y/ab.glb"));
    EXPECT_FALSE(matchesPath("", "a"));
}

TEST(MatchesPath, agreesWithTryingEverything)
{
    std::mt19937 random(1);
    const auto word = [&](std::string_view letters, size_t longest)
    {
        std::string text;
        for (size_t i = random() % (longest + 1); i > 0; --i)
            text += letters[random() % letters.size()];
        return text;
    };
    size_t matches = 0;
    for (int i = 0; i < 20000; ++i)
    {
        Names pattern(1 + random() % 4);
        for (std::string& name : pattern)
            name = random() % 3 == 0 ? "**" : "a" + word("a*?", 2);
        Names names(1 + random() % 4);
        for (std::string& name : names)
            name = "a" + word("ab", 2);
        const bool expected = matchesNames(pattern, names);
        matches += expected ? 1 : 0;
        EXPECT_EQ(matchesPath(joined(pattern), joined(names)), expected)
            << joined(pattern) << " " << joined(names);
    }
    EXPECT_GT(matches, 2000u);
}

} // namespace hearth::profiles
