// Tests a window that is flown through by synthetic user events, with the validation layer enabled.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/shading.h"
#include "runtime/viewer/window/viewer.h"
#include "tests/reference/png_image.h"
#include "tests/roundtrip/cooked_sample.h"
#include "tests/support/sandbox.h"

#include <SDL.h>
#include <array>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

constexpr double kStep = 1.0 / 60;

class WindowTest : public testing::Test
{
protected:
    void SetUp() override { open(sample_, {}); }

    void open(const roundtrip::CookedSample& sample, const viewer::AnimationSettings& animation)
    {
        viewer::ViewOptions options = makeOptions();
        options.animation = animation;
        viewer_.reset(); // one at a time
        take(viewer::Viewer::create(options, sample.pack()));
    }

    /// Open a file.
    void open(const std::string& pack)
    {
        viewer::ViewOptions options = makeOptions();
        options.pack = pack;
        viewer_.reset();
        take(viewer::Viewer::create(options));
    }

    static viewer::ViewOptions makeOptions()
    {
        viewer::ViewOptions options;
        options.width = 320;
        options.height = 240;
        options.validate = true;
        options.shadows.options.max_maps = 4;
        options.shadows.fit_maps = false;
        return options;
    }

    void take(Result<std::unique_ptr<viewer::Viewer>> viewer)
    {
        ASSERT_TRUE(viewer.ok()) << formatMessage(viewer.error());
        viewer_ = std::move(viewer).value();
        settings().panel = false; // the mouse position has no effect then
        play();
    }

    void TearDown() override
    {
        ASSERT_NE(viewer_, nullptr);
        EXPECT_EQ(viewer_->host().messages(), std::vector<std::string>());
    }

    /// Run this many steps; returns how many of them presented a frame.
    uint32_t play(uint32_t steps = 3)
    {
        uint32_t shown = 0;
        for (uint32_t i = 0; i < steps; ++i)
        {
            const Result<bool> drawn = viewer_->step(kStep);
            EXPECT_TRUE(drawn.ok()) << formatMessage(drawn.error());
            shown += drawn.ok() && *drawn ? 1u : 0u;
        }
        return shown;
    }

    /// Press a key and release it after this many steps.
    void hold(SDL_Scancode code, uint32_t steps)
    {
        for (const uint32_t type : {SDL_KEYDOWN, SDL_KEYUP})
        {
            SDL_Event event{};
            event.type = type;
            event.key.keysym.scancode = code;
            event.key.keysym.sym = SDL_GetKeyFromScancode(code);
            SDL_PushEvent(&event);
            play(type == SDL_KEYDOWN ? steps : 1);
        }
    }

    void tellWindow(uint8_t what)
    {
        SDL_Event event{};
        event.type = SDL_WINDOWEVENT;
        event.window.event = what;
        SDL_PushEvent(&event);
    }

    viewer::ViewSettings& settings() { return viewer_->settings(); }
    const shared::Camera& camera() const { return viewer_->camera().camera(); }

    const roundtrip::CookedSample& sample_ = roundtrip::cookedSample({"rock", 150000});
    std::unique_ptr<viewer::Viewer> viewer_;
};

/// Return the mean of the red, green and blue values of a PNG file, 0 to 255.
Float3 meanColor(const std::string& file)
{
    const reference::Image image = reference::readPng(file).value();
    std::array<double, 3> sums{};
    for (size_t i = 0; i < image.rgb.size(); ++i)
        sums[i % 3] += image.rgb[i];
    const double pixels = static_cast<double>(image.rgb.size()) / 3;
    return {static_cast<float>(sums[0] / pixels), static_cast<float>(sums[1] / pixels),
            static_cast<float>(sums[2] / pixels)};
}

} // namespace

TEST_F(WindowTest, isFlownByKeysAndMouse)
{
    const shared::Camera start = camera();
    hold(SDL_SCANCODE_W, 10);
    const float flown = length(camera().position - start.position);
    EXPECT_NEAR(flown, viewer_->camera().speed() * 10 / 60, 0.01f * flown);
    const Float3 forward = start.target - start.position;
    EXPECT_GT(dot(camera().position - start.position, forward), 0);

    const float speed = viewer_->camera().speed();
    for (const uint32_t type : {SDL_MOUSEWHEEL, SDL_MOUSEBUTTONDOWN, SDL_MOUSEMOTION, SDL_MOUSEBUTTONUP})
    {
        SDL_Event event{};
        event.type = type;
        if (type == SDL_MOUSEWHEEL)
            event.wheel.y = 2;
        else if (type == SDL_MOUSEMOTION)
            event.motion.xrel = 40;
        else
            event.button.button = SDL_BUTTON_RIGHT;
        SDL_PushEvent(&event);
        play(1);
    }
    EXPECT_GT(viewer_->camera().speed(), 1.3f * speed);
    EXPECT_LT(dot(normalizeOr(camera().target - camera().position, {}), normalizeOr(forward, {})), 0.999f);

    hold(SDL_SCANCODE_R, 1);
    EXPECT_EQ(camera().position, start.position);
    EXPECT_EQ(camera().target, start.target);
}

TEST_F(WindowTest, showsEveryView)
{
    for (const viewer::Named<uint32_t>& view : viewer::viewNames())
    {
        if (shared::viewNeedsBricks(view.value)) // the pack has none
            continue;
        settings().frame.view = view.value;
        EXPECT_EQ(play(2), 2u) << view.name;
    }
    hold(SDL_SCANCODE_2, 1);
    EXPECT_EQ(settings().frame.view, shared::kViewClusters);
    hold(SDL_SCANCODE_0, 1);
    EXPECT_EQ(settings().frame.view, shared::kViewOverdraw);
}

TEST_F(WindowTest, drawsItsPanel)
{
    hold(SDL_SCANCODE_TAB, 1);
    EXPECT_TRUE(settings().panel);
    EXPECT_EQ(play(5), 5u);
    hold(SDL_SCANCODE_TAB, 1);
    EXPECT_FALSE(settings().panel);
}

TEST_F(WindowTest, changesExposureBloomAndPhotoFilterWhileItIsOpen)
{
    const Sandbox folder;
    const auto mean = [&](const gpu::PostSettings& post)
    {
        settings().frame.post = post;
        EXPECT_EQ(play(3), 3u);
        EXPECT_TRUE(viewer_->saveScreenshot(folder / "view.png").ok());
        return meanColor(folder / "view.png");
    };
    const Float3 before = mean({});
    EXPECT_GT(mean({.exposure_stops = 1}).y, before.y + 10);
    EXPECT_LT(mean({.exposure_stops = -1}).y, before.y - 10);
    const Float3 warm = mean({.photo_filter = {.color = {1, 0.3f, 0}, .density = 0.5f}});
    EXPECT_GT(warm.x - before.x, 5);
    EXPECT_LT(warm.z - before.z, -5);
    EXPECT_GT(mean({.bloom = {.strength = 0.5f, .mode = gpu::BloomMode::add}}).y, before.y + 10);
    const gpu::AutomaticExposure at_once{.key = 0.02f, .time_constant = 0};
    EXPECT_LT(mean({.automatic_exposure = at_once}).y, before.y - 10);
    EXPECT_NEAR(mean({}).y, before.y, 0.1f) << "with targets that have no bloom again";
}

TEST_F(WindowTest, changesTheLightMethodWhileItIsOpen)
{
    const Sandbox folder;
    const auto mean = [&](gpu::LightMethod method)
    {
        settings().frame.light_method = method;
        EXPECT_EQ(play(3), 3u);
        EXPECT_TRUE(viewer_->saveScreenshot(folder / "view.png").ok());
        return meanColor(folder / "view.png");
    };
    const Float3 before = mean(gpu::LightMethod::practical);
    for (size_t i = 0; i < gpu::kLightMethodCount; ++i)
    {
        const gpu::LightMethodFacts& facts = gpu::kLightMethods[i];
        const Float3 drawn = mean(static_cast<gpu::LightMethod>(i));
        EXPECT_NEAR(drawn.y, before.y, facts.approximates ? 5 : 0.3) << facts.name;
    }
    settings().frame.post.exposure_stops = 1; // the renderer has all of it
    EXPECT_GT(mean(gpu::LightMethod::prepass).y, before.y + 10);
}

/// As the panel does, which is built when a frame has begun.
TEST_F(WindowTest, drawsFramesWithoutWhatIsNotPreparedYet)
{
    const Sandbox folder;
    settings().frame.light_method = gpu::LightMethod::tiled_forward;
    settings().frame.post.bloom.strength = 0.5f;
    EXPECT_TRUE(viewer_->saveScreenshot(folder / "view.png").ok());
    EXPECT_EQ(play(3), 3u);
}

TEST_F(WindowTest, followsItsSize)
{
    SDL_Window* window = SDL_GetWindowFromID(1);
    ASSERT_NE(window, nullptr);
    for (const auto& [width, height] : {std::pair{411, 307}, {200, 500}, {320, 240}})
    {
        SDL_SetWindowSize(window, width, height);
        for (int i = 0; i < 100 && viewer_->extent().width != static_cast<uint32_t>(width); ++i)
            play(1);
        EXPECT_EQ(viewer_->extent().width, static_cast<uint32_t>(width));
        EXPECT_EQ(viewer_->extent().height, static_cast<uint32_t>(height));
        EXPECT_EQ(play(4), 4u);
    }
}

TEST_F(WindowTest, restsWhileItIsMinimized)
{
    tellWindow(SDL_WINDOWEVENT_MINIMIZED);
    EXPECT_EQ(play(3), 0u);
    tellWindow(SDL_WINDOWEVENT_RESTORED);
    EXPECT_GE(play(3), 2u); // SDL may deliver the event a step later
}

TEST_F(WindowTest, takesAnotherBudgetAndKeepsTheSceneWhereThereIsNone)
{
    EXPECT_EQ(viewer_->scene().scene().stream, nullptr);
    settings().memory_budget = 8u << 20;
    play();
    const gpu::SceneStream* stream = viewer_->scene().scene().stream.get();
    ASSERT_NE(stream, nullptr);
    EXPECT_LE(stream->statistics().budget_bytes, 8u << 20);
    const uint64_t first = viewer_->serial() + 1;
    for (int i = 0; i < 1000 && !viewer_->settledSince(first); ++i)
        play(1);
    EXPECT_TRUE(viewer_->settledSince(first));
    EXPECT_GT(stream->statistics().pages_resident, 1u);

    settings().memory_budget = 16; // less than the pinned data
    play();
    EXPECT_EQ(settings().memory_budget, 8u << 20);
    EXPECT_EQ(viewer_->scene().scene().stream.get(), stream);
    settings().memory_budget = 0;
    play();
    EXPECT_EQ(viewer_->scene().scene().stream, nullptr);
}

TEST_F(WindowTest, showsEachVersionOfItsFile)
{
    const Sandbox folder;
    const std::string file = folder / "shown.hearth";
    const auto replace = [&](const std::string& by)
    {
        std::filesystem::copy_file(by, file + ".new", std::filesystem::copy_options::overwrite_existing);
        std::filesystem::rename(file + ".new", file);
        EXPECT_EQ(play(2), 2u);
    };
    const auto picture = [&]
    {
        EXPECT_TRUE(viewer_->saveScreenshot(folder / "shown.png").ok());
        return reference::readPng(folder / "shown.png").value().rgb;
    };
    const std::string& other = roundtrip::cookedSample({"character", 20000}).packPath();
    std::filesystem::copy_file(sample_.packPath(), file);
    open(file);
    const shared::Camera seen_from = camera();
    const auto first = picture();

    replace(other);
    EXPECT_EQ(viewer_->problem(), "");
    EXPECT_EQ(viewer_->pack().clips.front(), "walk");
    EXPECT_EQ(camera().position, seen_from.position) << "one keeps looking at what one changes";
    settings().camera = 0;
    play(1);
    const auto second = picture();
    EXPECT_NE(second, first);

    std::ofstream(folder / "broken") << "no pack";
    replace(folder / "broken");
    EXPECT_NE(viewer_->problem(), "");
    EXPECT_EQ(picture(), second) << "the last version stays";
    std::filesystem::remove(file);
    EXPECT_EQ(play(2), 2u);
    replace(sample_.packPath());
    EXPECT_EQ(viewer_->problem(), "");
    settings().camera = 0;
    play(1);
    EXPECT_EQ(picture(), first);

    open(other);
    EXPECT_EQ(picture(), second);
}

TEST_F(WindowTest, countsWhatTheTestsLeaveOut)
{
    settings().count_culling = true;
    play(5);
    const viewer::FrameStatistics& figures = viewer_->figures();
    EXPECT_GT(figures.counters.drawn_clusters, 0u);
    EXPECT_GT(figures.milliseconds[0], 0);
    ASSERT_TRUE(figures.culling);
    EXPECT_EQ(figures.culling->clusters.tested, sample_.pack().clusters().size());
    EXPECT_EQ(figures.culling->clusters.drawn, figures.counters.drawn_clusters);
    settings().count_culling = false;
    play(5);
    EXPECT_FALSE(viewer_->figures().culling);
}

TEST_F(WindowTest, playsTheClipsOfACharacter)
{
    open(roundtrip::cookedSample({"character", 20000}), {.clip = "walk"});
    const double begin = viewer_->pack().playback.clip()->seconds;
    play(12);
    EXPECT_NEAR(viewer_->pack().playback.clip()->seconds - begin, 0.2, 1e-9);
    hold(SDL_SCANCODE_SPACE, 1);
    const double still = viewer_->pack().playback.clip()->seconds;
    play(5);
    EXPECT_EQ(viewer_->pack().playback.clip()->seconds, still);
    hold(SDL_SCANCODE_SPACE, 1);

    settings().panel = true;
    settings().playback.clip = 1;
    EXPECT_EQ(play(5), 5u);
    ASSERT_TRUE(viewer_->pack().playback.fadedClip());
    EXPECT_EQ(viewer_->pack().playback.fadedClip()->animation, 0u);
    settings().memory_budget = 8u << 20; // the scene is reloaded, posed by the clip at once
    EXPECT_EQ(play(20), 20u);
    EXPECT_FALSE(viewer_->pack().playback.fadedClip());
    settings().playback.clip.reset();
    EXPECT_EQ(play(3), 3u);
    EXPECT_FALSE(viewer_->pack().playback.clip());
}

TEST_F(WindowTest, standsStillAtTheTimeThatIsGiven)
{
    open(roundtrip::cookedSample({"character", 20000}), {.clip = "1", .seconds = 0.75});
    play(5);
    EXPECT_EQ(viewer_->pack().playback.clip()->seconds, 0.75);
    EXPECT_FALSE(settings().playback.playing);
}

TEST_F(WindowTest, isClosed)
{
    EXPECT_TRUE(viewer_->isOpen());
    SDL_Event event{};
    event.type = SDL_QUIT;
    SDL_PushEvent(&event);
    play(1);
    EXPECT_FALSE(viewer_->isOpen());
}

} // namespace hearth::test
