// Checks the meaning of a pack: everything that a runtime relies on without checking again. See FORMAT.md,
// "Checking".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <functional>

namespace hearth::formats
{

// Bounds are computed and checked in floating point. A writer that works in 32-bit floats, rounds each
// operation once and rounds bounds up by one part in a million stays well inside these tolerances.

/// Tolerance of spheres: a sphere contains another, or a point, if the distance needed is at most radius * (1
/// + kSphereSlack).
inline constexpr double kSphereSlack = 1e-5;
/// Tolerance of cones: a normal lies in a cone if the sine of its angle to the axis is at most the cone's +
/// kConeSlack.
inline constexpr double kConeSlack = 1e-4;
/// Tolerance of apexes: an apex lies behind a plane if it is in front by at most kApexSlack * (half the
/// diagonal of the cluster's box + distance of the apex from the middle of the box).
inline constexpr double kApexSlack = 1e-4;
/// Tolerance of unit vectors: their length is within this of 1.
inline constexpr double kUnitSlack = 1e-3;
/// Largest width and height of an image, in texels.
inline constexpr uint32_t kMaxImageSize = 16384;

/// Loop that runs work(0) ... work(count - 1), in any order and on any threads, and returns when all have
/// ended.
using PageLoop = std::function<void(uint32_t count, const std::function<void(uint32_t)>& work)>;

/// Run the loop on the calling thread.
void serialPageLoop(uint32_t count, const std::function<void(uint32_t)>& work);

/// Check everything, with pages checked in `loop`. Returns the first error in reading order, whatever the
/// loop does: texts, materials, images, skins, animations, nodes, instances, cameras, lights, shadow spheres,
/// then checkHierarchy, then references between tables. Time linear in the size of the tables and decoded
/// pages; safe on any container.
/// errors: container_kind, chunk_*, page_hash, meaning_*.
Status checkPack(const PackView& view, const PageLoop& loop = serialPageLoop);

/// Check everything except the bytes of geometry pages and texels, which are not read. PackView::checkPage
/// checks a page, PackView::imageData checks texels when it returns them. Returns the first error in the
/// order of checkPack.
Status checkTables(const PackView& view);

/// Check only skins, animations and the node tree: the contents of an import part.
Status checkAnimationTables(const PackView& view);

/// Check only meshes, levels, groups, clusters, pages and geometry: the contents of a clusters part.
Status checkHierarchy(const PackView& view, const PageLoop& loop = serialPageLoop);

/// Check only the table of specular occlusion: the contents of a specular part.
Status checkSpecular(const PackView& view);

/// Check only the probes: the contents of a probe part.
Status checkProbes(const PackView& view);

/// Check only the receivers: the contents of a receivers part. Lights and instances are in the import part.
Status checkReceivers(const PackView& view);

/// Check only the proxies: the contents of a proxy part. Meshes and materials are in other parts.
Status checkProxies(const PackView& view);

/// Check only the grid of bricks: the contents of a bricks part.
Status checkBricks(const PackView& view);

} // namespace hearth::formats
