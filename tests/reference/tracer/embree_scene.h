// Traces rays against the finest level of a pack, with Embree.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/surface_point.h"

#include <functional>
#include <memory>
#include <optional>

namespace hearth::reference
{

struct Ray
{
    Double3 origin;
    Double3 direction; ///< unit
    double least = 0;  ///< metres along the ray
    double greatest = 1e30;
};

/// True if a candidate hit counts: false for holes of alpha masks and culled back faces. Called from many
/// threads.
using AcceptHit = std::function<bool(const SurfaceHit&)>;

class EmbreeScene
{
public:
    /// Build level 0 of every instance. `placement` must outlive the scene.
    ///
    /// blocks  filter of the hits that end a ray of occluded(); none: the accepted hits
    EmbreeScene(const Placement& placement, AcceptHit accept, AcceptHit blocks = {});
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    std::optional<SurfaceHit> nearest(const Ray& ray) const;
    bool occluded(const Ray& ray) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hearth::reference
