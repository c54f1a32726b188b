// Packs with the extras of material functions and motions.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/runtime/c/c_fixture.h"
#include "tests/support/shapes.h"

#include <functional>
#include <string>

namespace hearth::test
{

/// Pack of a rock over a two-sided quad, both of one material.
/// offset  of both
class MaterialPack
{
public:
    MaterialPack(formats::MaterialRecord material, const std::string& extras,
                 const std::function<void(TestScene&, formats::MaterialRecord&)>& change = {},
                 Float3 offset = {})
    {
        if (change)
            change(scene_, material);
        const uint32_t index = scene_.addMaterial(material);
        if (!extras.empty())
            addExtras(index, extras);
        scene_.addInstance(scene_.addMesh(withMaterial(shapes::rock(24, 0.3f), index)), translated(offset));
        mesh::SourceMesh quad = makeQuad(6, 6);
        quad.colors.assign(4, {0, 0, 1, 1});
        scene_.addInstance(scene_.addMesh(withMaterial(quad, index)),
                           translated(Float3{0, 0, -1.5f} + offset));
        formats::LightRecord light{};
        light.node = kInvalidIndex;
        light.type = static_cast<uint32_t>(formats::LightType::point);
        light.color = {1, 1, 1};
        light.intensity = 60;
        light.range = 9;
        light.world_from_light = translated({2, 3, 3});
        scene_.addLight(light);
        bytes_ = scene_.model().bytes();
        EXPECT_EQ(
            hearth_pack_open_memory(bytes_.span().data(), bytes_.size(), "rock.hearth", &pack_, nullptr, 0),
            HEARTH_OK);
    }
    ~MaterialPack() { EXPECT_EQ(hearth_pack_close(pack_), HEARTH_OK); }
    MaterialPack(const MaterialPack&) = delete;
    MaterialPack& operator=(const MaterialPack&) = delete;

    hearth_pack* get() const { return pack_; }

private:
    void addExtras(uint32_t material, const std::string& json)
    {
        PackModel& model = scene_.model();
        const formats::StringRef text{static_cast<uint32_t>(model.strings.size()),
                                      static_cast<uint32_t>(json.size())};
        model.strings += json;
        model.extras.push_back({static_cast<uint32_t>(formats::ExtrasOwner::material), material, text});
    }

    TestScene scene_;
    AlignedBytes bytes_;
    hearth_pack* pack_ = nullptr;
};

inline formats::MaterialRecord doubleSided(formats::MaterialRecord material)
{
    material.flags |= formats::kMaterialDoubleSided;
    return material;
}

inline formats::MaterialRecord unlit()
{
    formats::MaterialRecord material = doubleSided(plainMaterial());
    material.flags |= formats::kMaterialUnlit;
    return material;
}

} // namespace hearth::test
