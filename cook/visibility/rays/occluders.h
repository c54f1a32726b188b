// What is in the way of rays: meshes and instances of them, as Embree sees them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

struct RTCSceneTy; ///< Embree's

namespace hearth::visibility
{

/// What rays do that meet the back of a triangle: the side from which its corners run clockwise.
enum class BackFaces
{
    block,       ///< as do the fronts: what is inside of a solid sees nothing
    let_through, ///< for meshes whose backs the renderer culls, so that what is under an open floor sees the sky
};

/// Whether a masked triangle is there at the point with the weights u and v of its corners 1 and 2: a look into the
/// material's texture. Called from many threads; has to answer the same each time.
using Mask = std::function<bool(uint32_t triangle, float u, float v)>;

struct OccluderMesh
{
    std::span<const Float3> positions; ///< finite
    std::span<const uint32_t> corners; ///< three positions' indices for each triangle, in range (asserted)
    BackFaces back_faces = BackFaces::block;
    /// None: all of it is there. Rays ask at each hit, so that triangles without a mask are better off in another mesh.
    Mask mask = {};
};

/// Built once, then read from many threads. The same for any number of threads.
class Occluders
{
public:
    enum class Mesh : uint32_t
    {
    };

    Occluders();
    ~Occluders();
    Occluders(Occluders&&) noexcept;
    Occluders& operator=(Occluders&&) noexcept;

    /// Copies what the spans show. In the world it is as often as it has instances.
    Mesh add(const OccluderMesh& mesh);

    /// world_from_mesh  invertible. Where it is exactly the identity rays meet the mesh itself, which is faster
    void place(Mesh mesh, const Affine3& world_from_mesh = {});

    /// Build what rays search. To be called once, after all meshes have their places.
    void finish();

    /// After finish(). For the parts of this folder that trace rays.
    RTCSceneTy* scene() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hearth::visibility
