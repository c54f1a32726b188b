// Occluders of rays: meshes and their instances in an Embree scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/gpu_shared/brick_codes.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

struct RTCSceneTy; ///< Embree's scene

namespace hearth::visibility
{

/// Effect of the back of a triangle on rays: the side from which its corners run clockwise.
enum class BackFaces
{
    block,       ///< like the front: samples inside a solid see nothing
    let_through, ///< for meshes with back-face culling: samples below an open floor see the sky
};

/// True if a masked triangle is opaque at the point with the weights u and v of its corners 1 and 2, by the
/// material's texture. Called from many threads; must return the same value each time.
using Mask = std::function<bool(uint32_t triangle, float u, float v)>;

struct OccluderMesh
{
    std::span<const Float3> positions; ///< finite
    std::span<const uint32_t> corners; ///< three position indices for each triangle, in range (asserted)
    BackFaces back_faces = BackFaces::block;
    /// Empty: the whole mesh is opaque. Rays call it at each hit, so put triangles without a mask into
    /// another mesh.
    Mask mask = {};
    /// One for each triangle: encodeSurfaceColor; empty: white fronts and backs. Only for Occluders::nearest.
    std::span<const uint32_t> colors = {};
};

/// Code the colour that a triangle reflects.
/// color         linear, clamped to [0, 1]
/// double_sided  its back is a surface, too
inline uint32_t encodeSurfaceColor(Float3 color, bool double_sided)
{
    return shared::encodeAlbedo(color) | (double_sided ? 1u << 30 : 0u);
}

/// Ray tracing scene: built once, then read from many threads. The same for any number of threads.
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

    /// Copy a mesh. The world contains it once for each call of place(). A mesh that equals an
    /// earlier one and has no mask is that one: exporters repeat meshes, and where copies are in the same
    /// place, each ray would test all.
    Mesh add(const OccluderMesh& mesh);

    /// Add an instance of a mesh. One in the same place as another adds nothing.
    /// world_from_mesh  invertible; if it is exactly the identity, rays hit the mesh without an instance,
    ///                  which is faster
    void place(Mesh mesh, const Affine3& world_from_mesh = {});

    /// Build the acceleration structure. Call once, after all instances are placed.
    void finish();

    /// Surface that a ray meets.
    struct Hit
    {
        float distance;
        Float3 normal; ///< unit, of the triangle, on the side of the ray's origin
        Float3 color;
        bool is_inside; ///< the ray comes from behind a surface that has only a front
    };

    /// Return the nearest surface along a ray, as rays to the sky meet it. Only after finish().
    std::optional<Hit> nearest(Float3 origin, Float3 direction) const;

    /// Return the Embree scene, for the code of this folder that traces rays. Only after finish().
    RTCSceneTy* scene() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace hearth::visibility
