// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/nearest_path.h"

#include "formats/base/nearest_match.h"
#include "pipelines/profiles/glob.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace hearth::profiles
{

namespace
{

// Limit of paths that are tried: each takes some microseconds, and an error message must not be delayed.
constexpr size_t kMaxPaths = 2000;

/// Return the offsets at which the names of a path start, the first at 0.
std::vector<size_t> nameStarts(std::string_view path)
{
    std::vector<size_t> starts{0};
    for (size_t slash = path.find('/'); slash != std::string_view::npos; slash = path.find('/', slash + 1))
        starts.push_back(slash + 1);
    return starts;
}

/// Return the extension, ".glb" of "props/chair.glb"; empty where the name has none.
std::string_view extension(std::string_view path)
{
    const std::string_view name = path.substr(nameStarts(path).back());
    const size_t dot = name.rfind('.');
    return dot == std::string_view::npos ? "" : name.substr(dot);
}

bool isGltf(std::string_view ending)
{
    return ending == ".glb" || ending == ".gltf";
}

/// Return the pattern with the extension of the path, or with one for all of glTF.
std::string withExtension(const std::string& pattern, const std::string& path)
{
    const std::string_view old = extension(pattern);
    const std::string_view ending = extension(path);
    if (old.empty() || ending.empty())
        return pattern;
    return pattern.substr(0, pattern.size() - old.size()) +
           std::string(isGltf(old) && isGltf(ending) ? ".gl*" : ending);
}

/// True if one of the pattern's names has no wildcards; without any it would match in every folder.
bool hasFixedName(std::string_view pattern)
{
    for (const size_t start : nameStarts(pattern))
        if (!isPattern(pattern.substr(start, pattern.find('/', start) - start)))
            return true;
    return false;
}

/// Return the pattern in the form that rules use: '/' between folders, and no "./" or "/" before the first.
std::string normalized(std::string pattern)
{
    std::replace(pattern.begin(), pattern.end(), '\\', '/');
    while (pattern.starts_with("./"))
        pattern.erase(0, 2);
    return pattern.substr(std::min(pattern.find_first_not_of('/'), pattern.size()));
}

/// Cost of the changes after which a pattern matches, compared first by folders, then by the extension, then
/// by letters.
using Cost = std::tuple<size_t, bool, size_t>;
constexpr Cost kMaxCost{SIZE_MAX, true, SIZE_MAX};

class PatternSearch
{
public:
    explicit PatternSearch(const std::string& pattern)
        : pattern_(normalized(pattern)), starts_(nameStarts(pattern_))
    {
    }

    /// Try the pattern with other folders at its start.
    void tryPath(const std::string& path)
    {
        const std::vector<size_t> folders = nameStarts(path);
        for (size_t removed = 0; removed < starts_.size(); ++removed)
        {
            const std::string rest = pattern_.substr(starts_[removed]);
            const size_t least = removed == 0 || hasFixedName(rest) ? 0 : removed;
            for (size_t added = least; added < folders.size() && removed + added <= std::get<0>(cost_);
                 ++added)
                tryPattern(path.substr(0, folders[added]) + rest, path, removed + added);
        }
    }

    const NearestPath& best() const { return best_; }

private:
    void tryPattern(const std::string& pattern, const std::string& path, size_t folders_changed)
    {
        for (const bool has_other_ending : {false, true})
        {
            const std::string tried = has_other_ending ? withExtension(pattern, path) : pattern;
            if (!matchesPath(tried, path))
                continue;
            const Cost cost{folders_changed, has_other_ending, editDistance(tried, pattern_)};
            if (cost < cost_)
            {
                cost_ = cost;
                best_ = {path, tried};
            }
            return;
        }
    }

    std::string pattern_;
    std::vector<size_t> starts_;
    Cost cost_ = kMaxCost;
    NearestPath best_;
};

} // namespace

std::optional<NearestPath> nearestPath(const std::string& pattern, std::span<const std::string> paths)
{
    paths = paths.first(std::min(paths.size(), kMaxPaths));
    if (paths.empty())
        return std::nullopt;
    PatternSearch search(pattern);
    for (const std::string& path : paths)
        search.tryPath(path);
    if (!search.best().path.empty())
        return search.best();
    const auto distance = [&](const std::string& path) { return editDistance(pattern, path); };
    return NearestPath{*std::min_element(paths.begin(), paths.end(),
                                         [&](const std::string& a, const std::string& b)
                                         { return distance(a) < distance(b); }),
                       ""};
}

} // namespace hearth::profiles
