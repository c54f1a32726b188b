// Adds proxies to scenes of tests.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "tests/support/small_pack.h"

namespace hearth::test
{

/// Add a proxy, behind those of earlier meshes.
///
/// distance  between a mesh and its proxy, both ways
inline void addProxy(PackModel& model, uint32_t mesh, const mesh::SourceMesh& proxy, float distance,
                     bool is_closed)
{
    const auto count = [](const auto& items) { return static_cast<uint32_t>(items.size()); };
    model.proxies.push_back({mesh,
                             static_cast<uint32_t>(formats::ProxyOrigin::wrapped),
                             is_closed ? 1u : 0u,
                             distance,
                             distance,
                             {count(model.proxy_positions), count(proxy.positions)},
                             {count(model.proxy_indices), count(proxy.indices)},
                             {count(model.proxy_sections), 1},
                             {count(model.proxy_bindings), 0},
                             {}});
    model.proxy_sections.push_back({{0, count(proxy.indices) / 3}, kInvalidIndex, 0});
    model.proxy_positions.insert(model.proxy_positions.end(), proxy.positions.begin(), proxy.positions.end());
    model.proxy_indices.insert(model.proxy_indices.end(), proxy.indices.begin(), proxy.indices.end());
}

} // namespace hearth::test
