// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/samples.h"

#include "sample_assets/attic.h"
#include "sample_assets/camp.h"
#include "sample_assets/field.h"
#include "sample_assets/gallery.h"
#include "sample_assets/grass.h"
#include "sample_assets/hearth_scene.h"
#include "sample_assets/land.h"
#include "sample_assets/market.h"
#include "sample_assets/outdoor.h"
#include "sample_assets/people/character.h"
#include "sample_assets/rock.h"
#include "sample_assets/room.h"
#include "sample_assets/shapes/noise.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/spheres.h"
#include "sample_assets/terrain.h"

#include <array>
#include <cmath>

namespace hearth::samples
{

namespace
{

uint64_t trianglesOr(const SampleOptions& options, uint64_t otherwise)
{
    return options.triangles ? options.triangles : otherwise;
}

uint32_t textureSizeOr(const SampleOptions& options, uint32_t otherwise)
{
    return options.texture_size ? options.texture_size : otherwise;
}

Document generateRock(const SampleOptions& options)
{
    Document document;
    const int material = addRockMaterial(document, textureSizeOr(options, 1024));
    addObject(document, "rock", {{makeRock(trianglesOr(options, 50000), 1, 2.0f), material}});
    return document;
}

HeightGrid sampleHeights(uint64_t triangles)
{
    const auto cells = static_cast<uint32_t>(std::sqrt(static_cast<double>(triangles) / 2) + 0.5);
    return makeHeights({.size = 32, .cells = std::max(1u, cells), .seed = 3});
}

Document generateTerrain(const SampleOptions& options)
{
    Document document;
    const HeightGrid grid = sampleHeights(trianglesOr(options, 131072));
    const int material = addTerrainMaterial(document, grid, textureSizeOr(options, 1024));
    addObject(document, "terrain", {{makeTerrain(grid), material}});
    return document;
}

Document generateGrass(const SampleOptions& options)
{
    Document document;
    const HeightGrid grid = makeHeights({.size = 8, .cells = 32, .seed = 5});
    const int ground = addTerrainMaterial(document, grid, textureSizeOr(options, 512));
    addObject(document, "ground", {{makeTerrain(grid), ground}});
    const TriangleMesh tuft = makeGrassTuft();
    const uint64_t tufts = trianglesOr(options, 100000) / (tuft.indices.size() / 3);
    Node node;
    node.name = "grass";
    node.instances = scatterGrass(grid, static_cast<uint32_t>(tufts), 0, 7);
    node.mesh = add(document.meshes, Mesh{"grass_tuft", {{tuft, addGrassMaterial(document)}}});
    addRoot(document, node);
    return document;
}

Document generateRoom(const SampleOptions&)
{
    return makeRoom();
}

Document generateAttic(const SampleOptions&)
{
    return makeAttic();
}

Document generateGallery(const SampleOptions&)
{
    return makeGallery();
}

Document generateOutdoor(const SampleOptions&)
{
    return makeOutdoor();
}

Document generateSpheres(const SampleOptions&)
{
    return makeSpheres();
}

Document generateCharacter(const SampleOptions& options)
{
    Document document;
    const auto wanted = static_cast<double>(trianglesOr(options, 30000));
    const Pose pose = standingPose();
    const CharacterNodes nodes =
        addCharacter(document, pose, pose, static_cast<float>(std::sqrt(4.4 / wanted)));
    addWalkClip(document, nodes, pose);
    addWaveClip(document, nodes, pose);
    return document;
}

/// Make a small rock under nodes that mirror, stretch and, nested, shear it: difficult cases for culling by
/// bounds.
Document generateTransforms(const SampleOptions& options)
{
    Document document;
    const int material = addRockMaterial(document, textureSizeOr(options, 64));
    const TriangleMesh rock = makeRock(trianglesOr(options, 3000), 5, 2.0f);
    const int mesh = add(document.meshes, Mesh{"rock", {{rock, material}}});
    for (uint32_t i = 0; i < 12; ++i)
    {
        const auto random = [&](uint32_t which) { return randomUnit(i * 16 + which, 71); };
        Node inner;
        inner.name = "inner_" + std::to_string(i);
        inner.mesh = mesh;
        inner.placement.rotation = rotationAbout(normalize({random(0), random(1), random(2)}), 3 * random(3));
        inner.placement.scale = {i % 2 ? -1.0f : 1.0f, 0.3f + random(4), 0.3f + random(5)};
        Node outer;
        outer.name = "outer_" + std::to_string(i);
        outer.children = {add(document.nodes, inner)};
        outer.placement.translation = {static_cast<float>(i % 4) * 3 - 4.5f, 0,
                                       static_cast<float>(i / 4) * 3 - 3};
        outer.placement.rotation = rotationAbout({0, 0, 1}, 2 * random(6));
        outer.placement.scale = {0.4f + random(7), i % 3 ? 0.8f : -0.8f, 0.4f + random(8)};
        addRoot(document, outer);
    }
    return document;
}

Document generateScene(const SampleOptions& options)
{
    return makeHearthScene(trianglesOr(options, 2000000), textureSizeOr(options, 2048));
}

Document generateField(const SampleOptions& options)
{
    return makeField(trianglesOr(options, 2000000), 4, textureSizeOr(options, 4096));
}

Document generateRocks(const SampleOptions& options)
{
    return makeField(trianglesOr(options, 2000000), 40, textureSizeOr(options, 4096));
}

Document generateLand(const SampleOptions& options)
{
    return makeLand(trianglesOr(options, 2000000), textureSizeOr(options, 2048));
}

Document generateCamp(const SampleOptions& options)
{
    return makeCamp(trianglesOr(options, 80000), textureSizeOr(options, 1024));
}

Document generateMarket(const SampleOptions& options)
{
    return makeMarket(options.lights ? options.lights : 192);
}

constexpr std::array kKinds{
    SampleKind{"rock", "a boulder of 50k triangles with colour, roughness and normal textures", generateRock},
    SampleKind{"terrain", "a tile of eroded ground, 131k triangles, coloured by slope", generateTerrain},
    SampleKind{"grass", "thousands of alpha-masked grass tufts, instanced, on a patch of ground",
               generateGrass},
    SampleKind{"room", "a furnished room: many materials, three lights, emissive surfaces, a camera",
               generateRoom},
    SampleKind{"attic", "an L-shaped room below slanted roofs, lit through a window and by a lantern",
               generateAttic},
    SampleKind{"gallery", "three bays that eight lamps light, each to be dimmed: for baked light",
               generateGallery},
    SampleKind{"outdoor", "a yard: corners, an overhang, crates, tufts of grass, under sky and sun",
               generateOutdoor},
    SampleKind{"spheres", "spheres of five roughnesses, dielectric and metal, under sky and sun",
               generateSpheres},
    SampleKind{"market", "a night market: 192 lights, or --lights N, that flicker, swing and pass by",
               generateMarket},
    SampleKind{"character", "a skinned mannequin of seventeen joints with a walk and a wave",
               generateCharacter},
    SampleKind{"transforms", "a small rock, mirrored, stretched and sheared", generateTransforms},
    SampleKind{"scene", "the demo: a campfire at dusk before a boulder of 2 million triangles",
               generateScene},
    SampleKind{"field", "the benchmark: 40 rocks of 2 million triangles, 4096 tiles of ground, 10,000 tufts",
               generateField},
    SampleKind{"rocks", "the field with no two rocks alike: 84 million triangles to cook", generateRocks},
    SampleKind{"camp",
               "the sample game's world: a fire between rocks, lamps, a character that walks and runs",
               generateCamp},
    SampleKind{"land",
               "512 m of hills, 2 million triangles, with 120 rocks and 12 houses: to be lit by bricks",
               generateLand},
};

} // namespace

std::span<const SampleKind> sampleKinds()
{
    return kKinds;
}

Result<Document> generateSample(std::string_view kind, const SampleOptions& options)
{
    std::string names;
    for (const SampleKind& known : kKinds)
    {
        if (known.name == kind)
            return known.generate(options);
        names += (names.empty() ? "" : ", ") + std::string(known.name);
    }
    return Error{Issue::usage, "", "", "there is no sample '" + std::string(kind) + "'; there are " + names};
}

} // namespace hearth::samples
