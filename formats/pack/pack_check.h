// Checks what a pack means: everything that a runtime relies on without looking again. See FORMAT.md, "Checking".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <functional>

namespace hearth::formats
{

// Bounds are computed and checked in floating point. A writer that works in 32-bit floats, rounds each operation once
// and rounds bounds up by one part in a million stays well inside what is allowed here.

/// A sphere contains another, or a point, if the distance needed is at most radius * (1 + kSphereSlack).
inline constexpr double kSphereSlack = 1e-5;
/// A normal lies in a cone if the sine of its angle to the axis is at most the cone's + kConeSlack.
inline constexpr double kConeSlack = 1e-4;
/// An apex lies behind a plane if it is in front by at most kApexSlack * (half the diagonal of the cluster's box +
/// distance of the apex from the middle of the box).
inline constexpr double kApexSlack = 1e-4;
/// Vectors that must be unit have a length within this of 1.
inline constexpr double kUnitSlack = 1e-3;
/// Largest width and height of an image.
inline constexpr uint32_t kImageMaxSize = 16384;

/// Runs work(0) ... work(count - 1), in any order and on any threads, and returns when all have ended.
using PageLoop = std::function<void(uint32_t count, const std::function<void(uint32_t)>& work)>;

/// The loop of one thread.
void pageByPage(uint32_t count, const std::function<void(uint32_t)>& work);

/// Check everything, pages by `loop`. The first error in reading order is returned, whatever the loop does: texts, materials,
/// images, skins, animations, nodes, instances, cameras, lights, shadow spheres, then checkHierarchy, then what refers from
/// one to the other. Time linear in the size of the tables and decoded pages; safe on any container.
/// errors: container_kind, chunk_*, page_hash, meaning_*.
Status checkPack(const PackView& view, const PageLoop& loop = pageByPage);

/// checkPack but for geometry pages and texels, of whose bytes none is read: the pages are right where
/// PackView::checkPage says so, texels where PackView::imageData hands them out. The first error in the same order.
Status checkTables(const PackView& view);

/// Check skins, animations and the tree of nodes alone: what an import part already has.
Status checkMotion(const PackView& view);

/// Check meshes, levels, groups, clusters, pages and geometry alone: what a clusters part already has.
Status checkHierarchy(const PackView& view, const PageLoop& loop = pageByPage);

/// Check the table of specular occlusion alone: what a specular part has.
Status checkSpecular(const PackView& view);

/// Check the grid of bricks alone: what a bricks part has.
Status checkBricks(const PackView& view);

} // namespace hearth::formats
