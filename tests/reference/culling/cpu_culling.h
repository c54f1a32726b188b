// Exhaustive culling on the CPU: every cluster of every instance is asked, nothing is skipped.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/frame/frame.h"
#include "tests/reference/pack_geometry.h"

namespace hearth::reference
{

/// What is drawn, ordered by instance and then cluster, by the C++ twin of the shaders (formats/gpu_shared/decisions.h).
/// Must equal the GPU's visible set exactly, but for deformed instances, which are looked at here as if they were rigid in their
/// bind pose.
std::vector<DrawnCluster> cullExhaustively(const formats::PackView& view, const shared::FrameView& frame);

} // namespace hearth::reference
