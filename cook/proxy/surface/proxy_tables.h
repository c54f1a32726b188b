// Tables of proxies, as parts and packs have them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/surface/binding.h"
#include "cook/proxy/surface/surface.h"
#include "formats/container/container_writer.h"
#include "formats/records/proxy.h"

#include <vector>

namespace hearth::proxy
{

/// Proxy of a mesh before it is written.
struct MadeProxy
{
    formats::ProxyOrigin origin = formats::ProxyOrigin::cleaned;
    bool is_closed = false;
    Distances distances;
    Surface surface;
    std::vector<formats::ProxySectionRecord> sections; ///< all triangles, in order
    std::vector<formats::ProxyBindingRecord> bindings;
};

/// True if each half-edge is joined with another one.
bool isClosed(const Surface& surface);

/// Bring triangles with one material together, those without one last, and drop positions that no triangle
/// has. Positions are in the order in which the triangles use them first: a surface that is written, read
/// and sorted again stays the same.
void sortByMaterial(Surface& surface);

/// Return a section for each material of the surface, whose triangles are sorted by it.
std::vector<formats::ProxySectionRecord> makeMaterialSections(const Surface& surface);

/// Return the bytes of a proxy in a file that is not compressed.
uint64_t countBytes(const formats::ProxyRecord& record);

/// Tables of the proxies of several meshes.
struct ProxyTables
{
    std::vector<formats::ProxyRecord> proxies;
    std::vector<formats::ProxySectionRecord> sections;
    std::vector<Float3> positions;
    std::vector<uint32_t> indices;
    std::vector<formats::ProxyBindingRecord> bindings;

    /// Append the next proxy of `mesh`. Meshes come in ascending order.
    /// made  at least one triangle
    void add(uint32_t mesh, const MadeProxy& made);

    /// Write the chunks, also where there are no proxies.
    Status write(formats::ContainerWriter& writer) const;
};

} // namespace hearth::proxy
