// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/proxy_name.h"

#include <algorithm>

namespace hearth::import
{

namespace
{

constexpr std::string_view kConvexPrefix = "ucx_";
constexpr std::string_view kProxySuffix = "_proxy";

/// Return the name without its last number and the mark before it; nullopt if it has none, or is no more
/// than a number.
std::optional<std::string> withoutNumber(std::string_view name, char mark)
{
    const size_t end = name.find_last_not_of("0123456789");
    if (end == std::string_view::npos || end == 0 || end + 1 == name.size() || name[end] != mark)
        return std::nullopt;
    return std::string(name.substr(0, end));
}

} // namespace

std::string lowerProxyStem(std::string_view name)
{
    std::string lower(name);
    std::ranges::transform(lower, lower.begin(),
                           [](char c)
                           { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return lower;
}

std::optional<ProxyName> parseProxyName(std::string_view name)
{
    const std::string lower = lowerProxyStem(name);
    ProxyName parsed;
    if (lower.starts_with(kConvexPrefix) && lower.size() > kConvexPrefix.size())
    {
        parsed.is_convex = true;
        parsed.stems.push_back(lower.substr(kConvexPrefix.size()));
        for (const char mark : {'.', '_'})
            if (auto stem = withoutNumber(parsed.stems.back(), mark))
                parsed.stems.push_back(*std::move(stem));
        return parsed;
    }
    const std::string whole = lower.ends_with(kProxySuffix) ? lower : withoutNumber(lower, '.').value_or("");
    if (!whole.ends_with(kProxySuffix) || whole.size() == kProxySuffix.size())
        return std::nullopt;
    parsed.stems.push_back(whole.substr(0, whole.size() - kProxySuffix.size()));
    return parsed;
}

} // namespace hearth::import
