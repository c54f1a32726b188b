// Checks what a proxy part states about its proxies. Takes nothing from the code that makes them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "formats/pack/pack_view.h"
#include "tests/support/surfaces/certified_distance.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::test
{

/// Import, clusters and proxy part of one source.
struct ProxyParts
{
    formats::PackView import_part;
    formats::PackView clusters_part;
    formats::PackView proxy_part;
};

/// Open NAME.import.part, NAME.clusters.part and NAME.proxy.part. errors: those of PackView::read
Result<ProxyParts> openProxyParts(const std::string& name);

/// Proxy of a part beside the mesh that it stands for. Valid as long as its part is.
struct CheckedProxy
{
    formats::ProxyRecord record{};
    TriangleSurface surface;
    std::span<const formats::ProxyBindingRecord> bindings;
    mesh::SourceMesh mesh; ///< as it was imported

    TriangleSurface meshSurface() const { return {mesh.positions, mesh.indices}; }
    /// Return the diagonal of the box around the mesh's triangles, in metres.
    double diagonal() const;
    /// Return the rounding of floats at the size of the mesh's coordinates, in metres.
    double rounding() const;
};

/// errors: those of readSourceMesh
Result<CheckedProxy> readProxy(const ProxyParts& parts, size_t proxy);

/// Return what keeps the proxy from being a manifold, or where it is open and stored as closed or the
/// reverse; empty if nothing does.
std::string findShapeDefect(const CheckedProxy& proxy);

/// Return what is wrong with the bindings; empty if nothing is: there is one for each vertex of the mesh's
/// first level, whose place is on the proxy, at the stated distance, and at most eight times as far as the
/// nearest point. errors: those of PackView::decodePage
Result<std::string> findBindingDefect(const ProxyParts& parts, const CheckedProxy& proxy);

} // namespace hearth::test
