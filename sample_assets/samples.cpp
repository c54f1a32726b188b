// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/samples.h"

#include "sample_assets/rock.h"

#include <array>

namespace hearth::samples
{

namespace
{

Document generateRock(const SampleOptions& options)
{
    Document document;
    const int material = addRockMaterial(document, options.texture_size ? options.texture_size : 1024);
    const uint64_t triangles = options.triangles ? options.triangles : 50000;
    const int mesh = add(document.meshes, Mesh{"rock", {{makeRock(triangles, 1, 2.0f), material}}});
    Node node;
    node.name = "rock";
    node.mesh = mesh;
    addRoot(document, node);
    return document;
}

constexpr std::array kKinds{
    SampleKind{"rock", "a boulder of 50k triangles (--triangles) with colour, roughness and normal textures",
               generateRock},
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
