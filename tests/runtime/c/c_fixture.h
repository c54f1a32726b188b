// Fixture of the C API tests: a pack, a renderer behind hearth.h, and the same images by the C API and by the
// C++ classes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/c/hearth.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/test_scene.h"

#include <gmock/gmock.h>
#include <optional>
#include <thread>

extern "C"
{
#include "tests/runtime/c/c_caller.h"
}

namespace hearth::test
{

inline constexpr uint32_t kWidth = 160, kHeight = 120;

/// Camera of all frames here, for both APIs.
inline constexpr shared::Camera kCamera{
    .position = {4, 2, 5}, .target = {0, 0, 0}, .y_fov_rad = 0.9f, .z_near = 0.05f};
hearth_frame makeFrame();

/// Create targets for any scene, whose visibility buffer is kept.
hearth_result createTargets(hearth_renderer* renderer, uint32_t width, uint32_t height,
                            hearth_targets** targets);

/// Reads pages, each on a thread of its own.
struct Reader
{
    const hearth_pack* pack;
    uint32_t bad_page = kInvalidIndex; ///< page whose read fails
    std::vector<std::thread> threads;

    static void read(void* user, uint32_t page, void* destination, size_t size, hearth_page_read done);
    ~Reader();
};

/// Scene options for streaming with such a reader.
hearth_scene_options streamedBy(Reader& reader, uint64_t budget_bytes = 64 << 20);

/// A pack of rocks and a two-sided terrain of many pages at random places, and a renderer on the C program's
/// own device. Fails if the validation layers report anything of either device.
class CApiTest : public GpuTest
{
protected:
    void SetUp() override;
    void TearDown() override;

    /// Replace the renderer by one of this description.
    void recreateRenderer(const hearth_renderer_description& description);

    /// Draw with the C program; the arrays of the result belong to the test until the next call.
    c_image drawInC(const hearth_frame& frame,
                    const hearth_scene_options& options = HEARTH_SCENE_OPTIONS_INIT);
    /// Draw the whole scene by the classes of runtime/gpu.
    Image drawInCpp(DrawOptions options);
    /// Expect that the last image of drawInC equals this one in every pixel.
    void expectEqual(const c_image& c, const Image& cpp) const;

    TestScene test_;
    std::optional<formats::PackView> view_;
    AlignedBytes bytes_;
    bool in_parts_ = false;        ///< drawInC records frames in parts
    std::optional<Affine3> moved_; ///< of instance 0, in drawInCpp
    Float2 shift_{};               ///< of the camera, in drawInCpp
    gpu::ShadowOptions shadows_;   ///< in drawInCpp
    hearth_pack* pack_ = nullptr;
    c_caller* caller_ = nullptr;
    hearth_renderer* renderer_ = nullptr;
    char message_[512] = "";
    std::vector<uint32_t> color_, visibility_;
    std::vector<hearth_image> colors_; ///< images that drawInC shows, the first of them; none: the library's
};

} // namespace hearth::test
