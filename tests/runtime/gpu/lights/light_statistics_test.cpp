// Tests the statistics of lights of each method against counts on the CPU.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/light_bits.h"
#include "formats/gpu_shared/light_boxes.h"
#include "formats/gpu_shared/light_volume.h"
#include "runtime/gpu/statistics/light_statistics_pass.h"
#include "tests/runtime/frame/light_cases.h"
#include "tests/runtime/gpu/lights/all_lights_test.h"
#include "tests/runtime/gpu/lights/random_light.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <map>

namespace hearth::test
{

namespace
{

using formats::LightRecord;
using formats::LightType;

constexpr uint32_t kWidth = 160, kHeight = 120;
constexpr uint32_t kSheets = 20; ///< each way, of 1 x 1 m
/// No edge of a slab lies at this depth.
constexpr float kEyeHeight = 6.83f;
constexpr shared::Camera kFromAbove{.position = {0, kEyeHeight, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}};

/// Lists of a frame: lights of each area, and the area of each pixel.
struct AreaLists
{
    std::map<uint32_t, uint32_t> lights;
    std::vector<uint32_t> pixels;
};

shared::LightListCounts countLists(const AreaLists& areas)
{
    shared::LightListCounts counts{};
    for (const auto& [area, lights] : areas.lights)
    {
        counts.cells += lights > 0 ? 1 : 0;
        counts.indices += lights;
    }
    for (const uint32_t area : areas.pixels)
    {
        const uint32_t lights = areas.lights.at(area);
        counts.evaluated_low += lights;
        counts.longest = std::max(counts.longest, lights);
    }
    return counts;
}

/// A ground of sheets seen from straight above: places and depths of pixels are known.
class LightStatisticsTest : public AllLightsTest
{
protected:
    void SetUp() override
    {
        AllLightsTest::SetUp();
        if (IsSkipped())
            return;
        const uint32_t sheet =
            test_.addMesh(withMaterial(makeQuad(1, 1), test_.addMaterial(plainMaterial())));
        for (uint32_t i = 0; i < kSheets * kSheets; ++i)
            test_.addInstance(sheet, lying(sheetMiddle(i)));
        std::mt19937 random(3);
        for (uint32_t i = 0; i < 320; ++i)
            test_.addLight(randomLight(random, 4));
        pack_.emplace(test_.build());
        scene_ = upload(*pack_);
        for (size_t method = 0; method < gpu::kLightMethodCount; ++method)
            ASSERT_TRUE(renderer().prepareLightMethod(*scene_, static_cast<gpu::LightMethod>(method)).ok());
        layout_ = shared::makeLightGrid(
            shared::lightGridView(makeView(*scene_, kFromAbove, {.width = kWidth, .height = kHeight})));
        for (const shared::Light& light : scene_->lights->lights())
            if (const shared::CellLight seen = makeCellLight(layout_.grid, light);
                isLightInView(layout_.grid, seen))
                in_view_.push_back(seen);
        targets_.emplace(makeTargets(kWidth, kHeight));
        auto pass =
            gpu::LightStatisticsPass::create(renderer().device(), renderer().layouts(), *scene_, *targets_);
        ASSERT_TRUE(pass.ok());
        pass_.emplace(std::move(*pass));
    }

    static Float3 sheetMiddle(uint32_t number)
    {
        constexpr float kFirst = 0.5f - kSheets / 2.0f;
        return {kFirst + static_cast<float>(number % kSheets), 0,
                kFirst + static_cast<float>(number / kSheets)};
    }

    /// Draw a frame of a method, and return its counts.
    shared::LightListCounts count(gpu::LightMethod method)
    {
        image_ = draw(*scene_, *targets_, kFromAbove,
                      {.width = kWidth, .height = kHeight, .light_method = method});
        EXPECT_TRUE(host()
                        .run(
                            [&](VkCommandBuffer commands)
                            {
                                pass_->record(renderer().device(), commands, *scene_, *targets_, method);
                                return success();
                            })
                        .ok());
        return gpu::readLightCounts(*scene_);
    }

    template <typename Test>
    uint32_t countLights(const Test& test) const
    {
        return static_cast<uint32_t>(std::count_if(in_view_.begin(), in_view_.end(), test));
    }

    template <typename Area>
    static void addPixels(AreaLists& areas, const Area& area)
    {
        for (uint32_t y = 0; y < kHeight; ++y)
            for (uint32_t x = 0; x < kWidth; ++x)
                areas.pixels.push_back(area(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
    }

    AreaLists listTiles() const
    {
        AreaLists areas;
        const shared::LightCascade& tiles = layout_.tiles;
        const shared::LightSlab slab = tileSlab(layout_.grid, kEyeHeight, kEyeHeight);
        for (uint32_t tile = 0; tile < tiles.columns * tiles.rows; ++tile)
        {
            const uint32_t column = tile % tiles.columns, number = tile / tiles.columns;
            const shared::LightRow row{lightRowEdge(layout_.grid, tiles, number),
                                       lightRowEdge(layout_.grid, tiles, number + 1)};
            const Float4 edges{lightColumnEdge(layout_.grid, tiles, column),
                               lightColumnEdge(layout_.grid, tiles, column + 1), row.begin, row.end};
            areas.lights[tile] = countLights(
                [&](const shared::CellLight& light)
                {
                    const shared::LightColumns columns = lightColumns(layout_.grid, tiles, light, slab, row);
                    return static_cast<int>(column) >= columns.first &&
                           static_cast<int>(column) <= columns.last &&
                           reachesCell(layout_.grid, light, slab, edges);
                });
        }
        addPixels(
            areas, [](float x, float y)
            { return static_cast<uint32_t>(y / 32) * ((kWidth + 31) / 32) + static_cast<uint32_t>(x / 32); });
        return areas;
    }

    /// Lists of the CPU, of all cells or of those with a pixel.
    AreaLists listCells(bool visible_only) const
    {
        AreaLists areas;
        ListMemory memory(scene_->lights->lights().size());
        shared::LightLists().assign(layout_, scene_->lights->lights(), memory.view());
        addPixels(areas, [&](float x, float y) { return cellAt(layout_, {x, y, kEyeHeight}); });
        for (uint32_t cell = 0; cell < layout_.grid.cell_count; ++cell)
            if (!visible_only)
                areas.lights[cell] = shared::lightCellCount(memory.cells[cell]);
        for (const uint32_t cell : areas.pixels)
            areas.lights[cell] = shared::lightCellCount(memory.cells[cell]);
        return areas;
    }

    /// Lists of the sheets that the last frame drew.
    AreaLists listSlots() const
    {
        AreaLists areas;
        for (const shared::VisibleCluster& slot : image_.list.slots)
        {
            const Float3 offset = sheetMiddle(slot.instance) - layout_.grid.eye;
            const Float3 half{0.5f, 0, 0.5f};
            const auto along = [&](Float3 axis)
            {
                const float reach = std::abs(axis.x) * half.x + std::abs(axis.z) * half.z;
                return std::pair{dot(axis, offset) - reach, dot(axis, offset) + reach};
            };
            const auto x = along(layout_.grid.right), y = along(layout_.grid.down),
                       z = along(layout_.grid.forward);
            const shared::LightBox box{{x.first, y.first, z.first}, {x.second, y.second, z.second}};
            areas.lights[slot.instance] =
                countLights([&](const shared::CellLight& light) { return reachesBox(light, box); });
        }
        for (const std::array<uint32_t, 3>& seen : image_.seen())
            areas.pixels.push_back(seen[0]);
        return areas;
    }

    /// Pairs of a pixel and a light that reaches it, by double and from the records.
    uint32_t countLitPairs()
    {
        uint32_t reaching = 0;
        const double half_height = double{kEyeHeight} * std::tan(0.5 * double{kFromAbove.y_fov_rad});
        const double pixel = 2 * half_height / kHeight;
        for (uint32_t y = 0; y < kHeight; ++y)
            for (uint32_t x = 0; x < kWidth; ++x)
            {
                const double place[] = {(x + 0.5 - kWidth / 2.0) * pixel, 0,
                                        (y + 0.5 - kHeight / 2.0) * pixel};
                for (const LightRecord& record : test_.model().lights)
                {
                    const auto& m = record.world_from_light.m;
                    double distance2 = 0, along = 0;
                    for (size_t axis = 0; axis < 3; ++axis)
                    {
                        const double offset = place[axis] - double{m[axis][3]};
                        distance2 += offset * offset;
                        along -= offset * double{m[axis][2]};
                    }
                    const double distance = std::sqrt(distance2);
                    reaching += distance < double{record.range} &&
                                (record.type == static_cast<uint32_t>(LightType::point) ||
                                 along > distance * std::cos(double{record.outer_cone_rad}));
                }
            }
        return reaching;
    }

    TestScene test_;
    std::optional<formats::PackView> pack_;
    std::unique_ptr<gpu::Scene> scene_;
    std::optional<gpu::FrameTargets> targets_;
    std::optional<gpu::LightStatisticsPass> pass_;
    shared::LightGridLayout layout_;
    std::vector<shared::CellLight> in_view_;
    Image image_; ///< of the last frame
};

} // namespace

TEST_F(LightStatisticsTest, countWhatPixelsEvaluateByEachMethod)
{
    const shared::LightListCounts all = count(gpu::LightMethod::all);
    EXPECT_EQ(all.ranged, in_view_.size());
    EXPECT_EQ(all.pixels, kWidth * kHeight);
    EXPECT_EQ(all.evaluated_low, kWidth * kHeight * all.ranged);
    EXPECT_EQ(all.longest, all.ranged);
    const uint32_t lit_pairs = countLitPairs();
    EXPECT_NEAR(all.reaching_low, lit_pairs, 1e-3 * lit_pairs) << "pixels on the edge of a light may differ";

    for (const gpu::LightMethod method :
         {gpu::LightMethod::practical, gpu::LightMethod::tiled_forward, gpu::LightMethod::clustered_forward,
          gpu::LightMethod::forward, gpu::LightMethod::tiled_deferred, gpu::LightMethod::clustered_deferred})
    {
        const shared::LightListCounts counts = count(method);
        const gpu::LightAreas listed = gpu::lightMethodFacts(method).areas;
        const shared::LightListCounts expected =
            countLists(listed == gpu::LightAreas::tiles   ? listTiles()
                       : listed == gpu::LightAreas::slots ? listSlots()
                                                          : listCells(needPixels(listed)));
        const char* const name = gpu::lightMethodFacts(method).name;
        EXPECT_EQ(counts.pixels, all.pixels) << name;
        EXPECT_EQ(counts.reaching_low, all.reaching_low) << name;
        EXPECT_EQ(counts.evaluated_low, expected.evaluated_low) << name;
        EXPECT_EQ(counts.longest, expected.longest) << name;
        EXPECT_EQ(counts.cells, expected.cells) << name;
        EXPECT_EQ(counts.indices, expected.indices) << name;
        EXPECT_EQ(counts.overflows, 0u) << name;
        EXPECT_LT(counts.evaluated_low, all.evaluated_low / 2) << name;
        EXPECT_EQ(count(method).evaluated_low, counts.evaluated_low)
            << name << ": counts begin anew in each frame";
    }
}

TEST_F(LightStatisticsTest, countThePixelsInVolumes)
{
    const float half_height = kEyeHeight * std::tan(0.5f * kFromAbove.y_fov_rad);
    const float pixel = 2 * half_height / kHeight;
    uint32_t enclosed = 0;
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x)
        {
            // of the view: right, down, along
            const Float3 place{(static_cast<float>(x) + 0.5f - kWidth / 2.0f) * pixel,
                               (static_cast<float>(y) + 0.5f - kHeight / 2.0f) * pixel, kEyeHeight};
            enclosed +=
                countLights([&](const shared::CellLight& light) { return isInLightVolume(light, place); });
        }
    const uint32_t reaching = count(gpu::LightMethod::all).reaching_low;
    for (const gpu::LightMethod method :
         {gpu::LightMethod::deferred, gpu::LightMethod::tile_deferred, gpu::LightMethod::prepass,
          gpu::LightMethod::classic_prepass, gpu::LightMethod::encoded_prepass})
    {
        const shared::LightListCounts counts = count(method);
        EXPECT_EQ(counts.reaching_low, reaching);
        EXPECT_NEAR(counts.evaluated_low, enclosed, 1e-3 * enclosed) << "pixels on the edge may differ";
        EXPECT_LT(counts.evaluated_low, 1.5 * reaching);
    }
}

TEST_F(LightStatisticsTest, countTheBitsOfPixelsAndListsOfCellsBehindThem)
{
    ASSERT_GT(in_view_.size(), 80u);
    ListMemory memory(scene_->lights->lights().size());
    shared::LightLists().assign(layout_, scene_->lights->lights(), memory.view());
    const float pixel = 2 * kEyeHeight * std::tan(0.5f * kFromAbove.y_fov_rad) / kHeight;
    uint32_t marked = 0, listed = 0;
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x)
        {
            const float column = static_cast<float>(x) + 0.5f, row = static_cast<float>(y) + 0.5f;
            const Float3 place{(column - kWidth / 2.0f) * pixel, (row - kHeight / 2.0f) * pixel, kEyeHeight};
            for (size_t i = 0; i < 64; ++i)
                marked += shared::mayReachPoint(in_view_[i], place) ? 1 : 0;
            const uint32_t word = memory.cells[cellAt(layout_, {column, row, kEyeHeight})];
            for (uint32_t i = 0; i < shared::lightCellCount(word); ++i)
            {
                const uint32_t pair = memory.indices[shared::lightCellOffset(word) + i / 2];
                listed += (i % 2 == 0 ? pair & 0xFFFFu : pair >> 16) >= 64 ? 1 : 0;
            }
        }
    const uint32_t reaching = count(gpu::LightMethod::all).reaching_low;
    const shared::LightListCounts counts = count(gpu::LightMethod::stack);
    EXPECT_EQ(counts.reaching_low, reaching);
    EXPECT_NEAR(counts.evaluated_low, marked + listed, 1e-3 * marked) << "pixels on the edge may differ";
    EXPECT_LT(counts.evaluated_low, count(gpu::LightMethod::practical).evaluated_low);
}

} // namespace hearth::test
