// Finds the meshes whose proxies can cast their shadows. C++ only. See runtime/gpu/README.md, "Shadows".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/gpu_shared/shadows/proxy_casters.h"
#include "formats/pack/pack_view.h"

#include <vector>

namespace hearth::shared
{

/// Proxies of a pack that cast shadows.
struct ProxyCasters
{
    std::vector<ProxyCaster> rows; ///< [meshes]
    std::vector<Box3> boxes;       ///< [meshes], object space; empty if the mesh casts its own shadow
};

/// Find the proxies that stand for all of a mesh in shadow maps: the only ones of meshes that are not
/// deformed, of materials that are opaque and lit, and at a known distance from their mesh. Others have
/// holes, a pose, or parts that cast no shadow, which a proxy lacks.
ProxyCasters findProxyCasters(const formats::PackView& pack);

} // namespace hearth::shared
