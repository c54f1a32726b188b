// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/roundtrip/draw_fixture.h"

#include "runtime/viewer/camera_fit.h"

namespace hearth::roundtrip
{

std::unique_ptr<TestDevice> DrawTest::device_;
std::string DrawTest::no_device_;

void DrawTest::SetUpTestSuite()
{
    device_ = TestDevice::create(no_device_);
}

void DrawTest::TearDownTestSuite()
{
    device_.reset();
}

void DrawTest::SetUp()
{
    // see the GPU tests: the test set-up installs a software driver
    ASSERT_NE(device_, nullptr) << no_device_;
}

void DrawTest::TearDown()
{
    if (!device_)
        return;
    for (const std::string& message : device_->takeMessages())
        ADD_FAILURE() << "validation: " << message;
}

std::vector<NamedView> makeViews(const formats::PackView& pack)
{
    const shared::Camera fit = viewer::fitCamera(pack, 1);
    const Float3 way = fit.position - fit.target;
    const auto at = [&](float distance, float x, float y)
    {
        shared::Camera camera = fit;
        const Float3 side = normalizeOr(cross({0, 1, 0}, way), {1, 0, 0}) * length(way);
        camera.position = fit.target + way * distance + side * x + Float3{0, y * length(way), 0};
        return camera;
    };
    const auto view = [](std::string name, const shared::Camera& camera, uint32_t width, uint32_t height,
                         float error) {
        return NamedView{std::move(name), {camera, width, height, error, shared::kCullEverything}};
    };

    shared::Camera wide = at(0.22f, 0.1f, 0.03f);
    wide.y_fov_rad = 2.0f;
    shared::Camera cut = at(0.12f, 0, 0);
    cut.z_near = 0.1f * length(way); // the near plane cuts visible geometry
    shared::Camera rolled = at(0.5f, 0.3f, 0.2f);
    rolled.up = normalizeOr({0.7f, 0.6f, 0.1f}, {0, 1, 0});
    return {view("fit", fit, 384, 384, 1),
            view("fit, source", fit, 384, 384, 0),
            view("coarse", fit, 333, 257, 12),
            view("within, wide angle", wide, 400, 300, 1),
            view("across the near plane", cut, 320, 320, 2),
            view("rolled and tall", rolled, 123, 511, 0.5f),
            view("from behind", at(-0.8f, 0.2f, -0.1f), 300, 200, 1),
            view("far away", at(12, 0, 0), 256, 256, 1),
            view("one pixel", fit, 1, 1, 1)};
}

std::vector<SampleSpec> drawnSamples()
{
    return {{"rock", 40000}, {"terrain", 30000},   {"grass", 60000},
            {"room"},        {"character", 20000}, {"transforms", 3000}};
}

} // namespace hearth::roundtrip
