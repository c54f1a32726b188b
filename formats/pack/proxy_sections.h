// Questions about the sections of a proxy. See formats/records/proxy.h.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <algorithm>

namespace hearth::formats
{

/// Return whether a proxy is made of convex parts, which contain much that is outside of its mesh.
inline bool hasConvexParts(const PackView& pack, const ProxyRecord& proxy)
{
    return std::ranges::any_of(recordsInRange(pack.proxySections(), proxy.sections),
                               [](const ProxySectionRecord& section) { return section.is_convex != 0; });
}

} // namespace hearth::formats
