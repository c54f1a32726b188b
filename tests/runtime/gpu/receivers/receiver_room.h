// Room whose walls receive baked light, for tests: irradiance in closed form at the middle of each texel.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/receivers/select/atlas.h"
#include "tests/support/lit_scene.h"

#include <optional>

namespace hearth::test
{

/// Floor, back wall and left wall, and a sheet in the room that has no rectangle. All face the lamps, and
/// nothing stands between, so that direct light needs no rays.
class ReceiverRoom
{
public:
    static constexpr uint32_t kWalls = 3;
    static constexpr uint32_t kSheet = 3; ///< instance
    static constexpr float kSize = 4;     ///< metres, of the walls each way
    static constexpr uint32_t kSide = 64; ///< texels of a rectangle

    /// is_diffuse  the material has no specular part
    explicit ReceiverRoom(bool is_diffuse = true)
    {
        formats::MaterialRecord material = plainMaterial();
        material.base_color = {0.5f, 0.6f, 0.7f, 1};
        const uint32_t paint = test_.addMaterial(material);
        if (is_diffuse)
        {
            formats::MaterialLayersRecord layers = formats::neutralLayers(paint);
            layers.specular = 0;
            test_.model().material_layers = {layers};
        }
        mesh::SourceMesh quad = makeQuad(kSize, kSize);
        for (const Float2 uv : quad.uvs[0])
            quad.uvs[1].push_back({uv.y, uv.x});
        const uint32_t wall = test_.addMesh(withMaterial(quad, paint));
        Affine3 left = translated({-kSize / 2, kSize / 2, 0});
        left.m[0][0] = left.m[2][2] = 0;
        left.m[0][2] = 1;
        left.m[2][0] = -1;
        walls_ = {lying({}), translated({0, kSize / 2, -kSize / 2}), left};
        for (const Affine3& place : walls_)
            test_.addInstance(wall, place);
        test_.addInstance(test_.addMesh(withMaterial(makeQuad(1, 1), paint)), translated({0.5f, 1.2f, 0}));
    }

    /// Add a lamp of the atlas, with a direct light that is baked unless it is a sun.
    void addLamp(const formats::LightRecord& record)
    {
        test_.addLight(record);
        lamps_.push_back(
            {static_cast<uint32_t>(formats::ReceiverLampKind::light), static_cast<uint32_t>(lamps_.size())});
    }

    /// Light that no lamp has, the same at all texels.
    void setSteady(Float3 irradiance) { steady_ = irradiance; }

    /// Let an instance emit, with an irradiance of its own at all texels.
    void addMeshLamp(uint32_t instance, Float3 irradiance)
    {
        mesh_lamps_.push_back({static_cast<uint32_t>(formats::ReceiverLampKind::mesh_light), instance});
        mesh_light_ = irradiance;
    }

    TestScene& scene() { return test_; }
    const Affine3& wall(uint32_t number) const { return walls_[number]; }

    /// Return the pack without receivers: all light is live.
    formats::PackView buildLive() { return test_.build(); }

    /// Return the pack with receivers of a UV set, 0 or 1, which swaps u and v.
    formats::PackView build(uint32_t uv_set = 0)
    {
        makeAtlas(uv_set);
        PackModel& model = test_.model();
        model.receiver_atlases = {atlas_.record};
        model.receiver_lamps = atlas_.lamps;
        model.receiver_rects = atlas_.rects;
        model.receiver_blocks = atlas_.blocks;
        model.receiver_words = atlas_.words;
        return test_.build();
    }

    formats::ReceiverTables tables() const { return atlas_.tables(); }

private:
    /// Irradiance of a light at a point of a surface, by KHR_lights_punctual.
    static Float3 irradiance(const formats::LightRecord& record, Float3 point, Float3 normal)
    {
        if (record.type == static_cast<uint32_t>(formats::LightType::directional))
            return {};
        const Float3 offset = transformPoint(record.world_from_light, {0, 0, 0}) - point;
        const float distance = length(offset);
        float share = std::max(dot(offset, normal), 0.0f) / (distance * distance * distance);
        if (record.range > 0)
            share *= std::max(1 - std::pow(distance / record.range, 4.0f), 0.0f);
        return record.color * (record.intensity * share);
    }

    void makeAtlas(uint32_t uv_set)
    {
        constexpr uint32_t kStep = kSide + 4;
        const uint32_t width = kWalls * kStep;
        std::vector<formats::ReceiverLampRecord> lamps{{0, 0}};
        lamps.insert(lamps.end(), lamps_.begin(), lamps_.end());
        lamps.insert(lamps.end(), mesh_lamps_.begin(), mesh_lamps_.end());
        std::vector<uint8_t> valid(size_t{width} * kStep);
        std::vector<Float3> light(valid.size() * lamps.size());
        std::vector<formats::ReceiverRectRecord> rects;
        for (uint32_t wall = 0; wall < kWalls; ++wall)
        {
            rects.push_back({wall, wall * kStep + 2, 2, kSide, kSide, uv_set});
            const Float3 normal = normalizeOr(transformVector(walls_[wall], {0, 0, 1}), {});
            for (uint32_t y = 0; y < kSide; ++y)
                for (uint32_t x = 0; x < kSide; ++x)
                {
                    const size_t texel = size_t{y + 2} * width + rects.back().x + x;
                    valid[texel] = 1;
                    float u = (static_cast<float>(x) + 0.5f) / kSide;
                    float v = (static_cast<float>(y) + 0.5f) / kSide;
                    if (uv_set == 1)
                        std::swap(u, v);
                    const Float3 point =
                        transformPoint(walls_[wall], {(u - 0.5f) * kSize, (0.5f - v) * kSize, 0});
                    Float3* const at = &light[texel * lamps.size()];
                    at[0] = steady_;
                    for (size_t i = 0; i < lamps_.size(); ++i)
                        at[1 + i] = irradiance(test_.model().lights[i], point, normal);
                    for (size_t i = 0; i < mesh_lamps_.size(); ++i)
                        at[1 + lamps_.size() + i] = mesh_light_;
                }
        }
        atlas_ = receivers::packAtlas({width, kStep, lamps, rects, valid, light}, {});
    }

    TestScene test_;
    std::array<Affine3, kWalls> walls_;
    std::vector<formats::ReceiverLampRecord> lamps_, mesh_lamps_;
    Float3 steady_{}, mesh_light_{};
    receivers::Atlas atlas_;
};

} // namespace hearth::test
