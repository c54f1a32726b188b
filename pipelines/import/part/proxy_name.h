// Parses the names of proxies that artists make: X_PROXY, and Unreal's UCX_X, UCX_X_01, ...
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

struct ProxyName
{
    bool is_convex = false; ///< UCX: a convex part
    /// Names that the mesh may have for which it stands, lower case, the likeliest first: UCX_Rock_01 is a
    /// part of a mesh Rock_01, or else part 1 of Rock.
    std::vector<std::string> stems;
};

/// Parse the name of a node or mesh, in any case; nullopt for other names. Blender's numbers for equal names
/// (UCX_Rock.001, Rock_PROXY.001) do not count, nor does Unreal's number of a part.
std::optional<ProxyName> parseProxyName(std::string_view name);

/// Return the name with A to Z in lower case, as the stems are.
std::string lowerProxyStem(std::string_view name);

} // namespace hearth::import
