// Exhaustive culling on the CPU: tests every cluster of every instance and skips nothing.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "tests/reference/pack_geometry.h"

namespace hearth::reference
{

/// Return the visible clusters, ordered by instance and then cluster, by the C++ twin of the shaders
/// (formats/gpu_shared/decisions.h). Must equal the GPU's visible set exactly, except for deformed instances,
/// which are treated here as rigid, in their bind pose.
std::vector<DrawnCluster> cullExhaustively(const formats::PackView& view, const shared::FrameView& frame);

} // namespace hearth::reference
