// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/viewer.h"

#include "formats/gpu_shared/debug_views.h"
#include "runtime/viewer/camera_path.h"
#include "runtime/viewer/file_output.h"
#include "runtime/viewer/window/window_commands.h"

#include <SDL.h>
#include <algorithm>
#include <cstdio>

namespace hearth::viewer
{

namespace
{

constexpr double kMaxStep = 0.1; // seconds: limits the jump after a long pause

/// The clip plays from its start, unless the command line sets a time.
PlaybackSettings playbackSettings(const AnimationSettings& options, const Playback& playback)
{
    PlaybackSettings settings;
    if (playback.clip())
        settings.clip = playback.clip()->animation;
    settings.playing = !options.seconds;
    return settings;
}

} // namespace

Viewer::Viewer(const ViewOptions& options, std::unique_ptr<ShownPack> shown)
    : options_(options),
      shown_(std::move(shown)),
      settings_{.frame = options.settings,
                .playback = playbackSettings(options.animation, shown_->playback),
                .memory_budget = options.memory_budget,
                .lamps = shown_->lamps,
                .daylight = options.daylight},
      panel_(settings_, shown_->geometryBytes()),
      camera_(shown_->cameras[0].camera, flySpeed(shown_->view(), shown_->cameras[0].camera.position)),
      shadow_spheres_(options.shadows.spheres)
{
}

Result<std::unique_ptr<Viewer>> Viewer::create(const ViewOptions& options, const formats::PackView& pack)
{
    HEARTH_ASSIGN_OR_RETURN(std::unique_ptr<ShownPack> shown, ShownPack::make(options, pack));
    return create(options, std::move(shown));
}

Result<std::unique_ptr<Viewer>> Viewer::create(const ViewOptions& options)
{
    // before it is opened: a change from here on is seen
    const std::optional<FileVersion> version = readFileVersion(options.pack);
    HEARTH_ASSIGN_OR_RETURN(std::unique_ptr<ShownPack> shown, ShownPack::open(options));
    HEARTH_ASSIGN_OR_RETURN(std::unique_ptr<Viewer> viewer, create(options, std::move(shown)));
    viewer->file_version_ = version;
    return viewer;
}

Result<std::unique_ptr<Viewer>> Viewer::create(const ViewOptions& options, std::unique_ptr<ShownPack> shown)
{
    std::unique_ptr<Viewer> viewer(new Viewer(options, std::move(shown)));
    HEARTH_TRY(viewer->open());
    return viewer;
}

Status Viewer::open()
{
    HEARTH_ASSIGN_OR_RETURN(
        window_, SdlWindow::create("Hearth: " + shown_->view().name(), options_.width, options_.height));
    const HostWindow host_window = window_->hostWindow();
    HEARTH_ASSIGN_OR_RETURN(
        host_, VulkanHost::create(
                   {.device_name = options_.device, .validate = options_.validate, .window = &host_window}));
    HEARTH_ASSIGN_OR_RETURN(vk_, loadWindowTable(host_->description()));
    HEARTH_ASSIGN_OR_RETURN(const VkSurfaceFormatKHR format, Swapchain::chooseFormat(*host_, vk_));
    // the panel offers the light methods of the path that the window begins with, and of simpler ones
    gpu::RendererOptions options = rendererOptions(settings_.frame);
    options.color_format = format.format;
    HEARTH_ASSIGN_OR_RETURN(renderer_, gpu::Renderer::create(host_->description(), options));
    HEARTH_TRY(renderer_->prepareOverdraw());
    const gpu::Device& device = renderer_->device();
    HEARTH_ASSIGN_OR_RETURN(swapchain_, Swapchain::create(*host_, device, vk_, format));
    HEARTH_ASSIGN_OR_RETURN(frames_, FrameRing::create(*host_, device, vk_));
    HEARTH_ASSIGN_OR_RETURN(meter_, FrameMeter::create(*host_, device));
    HEARTH_ASSIGN_OR_RETURN(imgui_, ImguiLayer::create(*window_, *host_, device, *swapchain_));
    HEARTH_ASSIGN_OR_RETURN(scene_, LoadedScene::load(*host_, *renderer_, shown_->view(),
                                                      settings_.memory_budget, shown_->shadows));
    return success();
}

Viewer::~Viewer()
{
    if (frames_ != nullptr)
        (void)frames_->waitForAll(); // a lost device has nothing in flight
}

Result<bool> Viewer::step(double seconds)
{
    frame_seconds_ = seconds;
    handleEvents();
    HEARTH_TRY(reloadIfReplaced());
    controls_.fly(camera_, static_cast<float>(std::clamp(seconds, 0.0, kMaxStep)));
    shown_->playback.advance(settings_.playback, std::max(seconds, 0.0));
    HEARTH_TRY(applySettings());
    if (resized_ && !minimized_)
        HEARTH_TRY(resize());
    if (minimized_ || !targets_)
    {
        constexpr int kMaxWaitMs = 50;
        SDL_WaitEventTimeout(nullptr, kMaxWaitMs);
        return false;
    }
    return drawFrame(settings_.panel, nullptr);
}

void Viewer::handleEvents()
{
    SDL_Event event;
    while (SDL_PollEvent(&event) != 0)
        handle(event);
}

void Viewer::handle(const SDL_Event& event)
{
    imgui_->handle(event);
    const FlyControls::CapturedInput captured =
        settings_.panel ? imgui_->capturedInput() : FlyControls::CapturedInput{};
    controls_.handle(event, captured, camera_);
    switch (event.type)
    {
    case SDL_QUIT:
        open_ = false;
        break;
    case SDL_KEYDOWN:
        if (!captured.keys && event.key.repeat == 0)
            handleKey(event.key.keysym.sym);
        break;
    case SDL_WINDOWEVENT:
        if (event.window.event == SDL_WINDOWEVENT_MINIMIZED)
            minimized_ = true;
        if (event.window.event == SDL_WINDOWEVENT_RESTORED)
            minimized_ = false;
        if (event.window.event == SDL_WINDOWEVENT_SIZE_CHANGED)
            resized_ = true;
        break;
    default:
        break;
    }
}

/// Handle the keys of README.md that do not fly.
void Viewer::handleKey(int32_t key)
{
    if (key == SDLK_ESCAPE)
        open_ = false;
    else if (key == SDLK_TAB)
        settings_.panel = !settings_.panel;
    else if (key == SDLK_SPACE)
        settings_.playback.playing = !settings_.playback.playing;
    else if (key == SDLK_r)
        settings_.camera = 0;
    else if (key == SDLK_c)
    {
        std::printf("--camera %s\n", formatCamera(camera_.camera()).c_str());
        std::fflush(stdout);
    }
    else if (key >= SDLK_0 && key <= SDLK_9)
    {
        const auto view = static_cast<size_t>(key == SDLK_0 ? 9 : key - SDLK_1);
        if (view < viewNames().size())
            settings_.frame.view = viewNames()[view].value;
    }
}

/// Apply the settings that are no part of a frame: camera, asset, and what reloads the scene. The next frame
/// is drawn with the others as they are now: its panel sets those of the frame after it.
Status Viewer::applySettings()
{
    if (settings_.camera)
        camera_ = FlyCamera(shown_->cameras[*settings_.camera].camera, camera_.speed());
    settings_.camera.reset();
    lookAtAsset();
    HEARTH_TRY(supportSettings());
    HEARTH_TRY(prepareLightMethod());
    drawn_ = settings_.frame;
    resized_ = resized_ || (targets_ && targets_->options().may_bloom != needsBloomLevels(drawn_));
    if (settings_.memory_budget == scene_->memoryBudget())
        return success();
    // the present scene stays until the new one is ready
    Result<std::unique_ptr<LoadedScene>> scene =
        LoadedScene::load(*host_, renderer(), shown_->view(), settings_.memory_budget, shown_->shadows);
    problem_ = scene.ok() ? "" : formatMessage(scene.error());
    if (!scene.ok())
    {
        settings_.memory_budget = scene_->memoryBudget();
        return success();
    }
    return show(std::move(scene).value());
}

/// Show the pack anew once its file is another one. A file that cannot be shown is reported, and the pack
/// stays.
Status Viewer::reloadIfReplaced()
{
    const std::optional<FileVersion> version = readFileVersion(options_.pack);
    if (!file_version_ || !version || version == file_version_)
        return success();
    file_version_ = version;
    const auto load = [&](std::unique_ptr<ShownPack>& pack) -> Result<std::unique_ptr<LoadedScene>>
    {
        HEARTH_ASSIGN_OR_RETURN(pack, ShownPack::open(options_));
        return LoadedScene::load(*host_, renderer(), pack->view(), settings_.memory_budget, pack->shadows);
    };
    std::unique_ptr<ShownPack> pack;
    Result<std::unique_ptr<LoadedScene>> scene = load(pack);
    problem_ = scene.ok() ? "" : formatMessage(scene.error());
    if (!scene.ok())
    {
        std::fprintf(stderr, "%s\n", problem_.c_str());
        return success();
    }
    keepChoices(*pack);
    HEARTH_TRY(show(std::move(scene).value(), std::move(pack)));
    panel_ = Panel(settings_, shown_->geometryBytes());
    resized_ = true; // targets have what the scene needs
    return success();
}

/// Take what was chosen over to another version of the pack, by names.
void Viewer::keepChoices(ShownPack& pack)
{
    const auto findIndex = [](const auto& list, const auto& same) -> std::optional<size_t>
    {
        const auto found = std::ranges::find_if(list, same);
        return found == list.end() ? std::nullopt : std::optional<size_t>(found - list.begin());
    };
    if (const std::optional<pack::ClipTime> clip = shown_->playback.clip())
    {
        const std::string& name = shown_->clips[clip->animation];
        if (const auto number =
                findIndex(pack.clips, [&](const std::string& other) { return other == name; }))
        {
            settings_.playback.clip = static_cast<uint32_t>(*number);
            pack.playback = Playback(clipDurations(pack.view()),
                                     pack::ClipTime{static_cast<uint32_t>(*number), clip->seconds},
                                     shown_->playback.flickerSeconds());
        }
        else
            settings_.playback.clip.reset();
    }
    if (asset_)
    {
        const std::string& name = shown_->assets.list[*asset_].name;
        asset_ = findIndex(pack.assets.list, [&](const AssetView& other) { return other.name == name; });
        settings_.asset = asset_;
    }
    for (LampControl& lamp : pack.lamps)
        if (const auto same = std::ranges::find(settings_.lamps, lamp.lamp.name,
                                                [](const LampControl& other) { return other.lamp.name; });
            same != settings_.lamps.end())
        {
            lamp.brightness = same->brightness;
            lamp.color = same->color;
        }
    settings_.lamps = pack.lamps;
    if (shared::viewNeedsBricks(settings_.frame.view) && pack.view().brickGrid().empty())
        settings_.frame.view = shared::kViewFinal;
}

/// Replace the scene.
/// pack  whose scene it is; null: the same as before
Status Viewer::show(std::unique_ptr<LoadedScene> scene, std::unique_ptr<ShownPack> pack)
{
    HEARTH_TRY(frames_->waitForAll());
    scene_ = std::move(scene);
    if (pack != nullptr)
        shown_ = std::move(pack);
    light_method_ = gpu::LightMethod::practical;
    HEARTH_TRY(prepareLightMethod());
    pose_ = FramePose();
    lights_ = FrameLights();
    lamp_weights_ = SceneLampWeights();
    scene_daylight_.reset();
    if (shown_->assets.stage)
        shown_->assets.stage->reset();
    return success();
}

/// Load the scene with a renderer for all of PostSettings, or for all light methods, once the settings need
/// more than the present one has. Not from the start: it has more pipelines, and rounds some pixels otherwise
/// than hearth-render.
Status Viewer::supportSettings()
{
    gpu::RendererOptions options = rendererOptions(settings_.frame);
    if (options.post <= renderer().postSupport() && renderer().supports(settings_.frame.light_method))
        return success();
    options.post = gpu::PostSupport::packed;
    options.color_format = swapchain_->format();
    options.deferred = options.deferred || renderer().supports(gpu::LightMethod::deferred);
    HEARTH_ASSIGN_OR_RETURN(std::unique_ptr<gpu::Renderer> renderer,
                            gpu::Renderer::create(host_->description(), options));
    HEARTH_TRY(renderer->prepareOverdraw());
    HEARTH_ASSIGN_OR_RETURN(
        std::unique_ptr<LoadedScene> scene,
        LoadedScene::load(*host_, *renderer, shown_->view(), scene_->memoryBudget(), shown_->shadows));
    HEARTH_TRY(frames_->waitForAll());
    targets_.reset();
    std::swap(extended_renderer_, renderer); // the one before goes after the scene that it drew
    resized_ = true;
    return show(std::move(scene));
}

/// Prepare the chosen light method, and targets for it.
Status Viewer::prepareLightMethod()
{
    if (light_method_ == settings_.frame.light_method)
        return success();
    HEARTH_TRY(frames_->waitForAll());
    light_method_ = settings_.frame.light_method;
    resized_ = true;
    return renderer().prepareLightMethod(scene_->scene(), light_method_);
}

/// Go to the chosen asset, or to the whole scene, and set a fly speed that suits its size.
void Viewer::lookAtAsset()
{
    if (asset_ == settings_.asset)
        return;
    asset_ = settings_.asset;
    const shared::Camera& camera = asset_ ? shown_->assets.list[*asset_].camera : shown_->cameras[1].camera;
    const float speed =
        asset_ ? length(camera.position - camera.target) / 4 : flySpeed(shown_->view(), camera.position);
    camera_ = FlyCamera(camera, speed);
}

/// Compute the moves, poses and lights of the next frame, for the clip and the shown asset.
Status Viewer::poseScene()
{
    shown_->playback.pose(shown_->player);
    HEARTH_TRY(pose_.take(shown_->player, scene_->scene()));
    moves_.assign(pose_.moves().begin(), pose_.moves().end());
    poses_ = pose_.poses();
    shown_->light_player.update(shown_->player, shown_->playback.flickerSeconds());
    lights_.clear();
    HEARTH_TRY(lights_.add(shown_->light_player, scene_->scene()));
    HEARTH_TRY(lamp_weights_.update(settings_.lamps, scene_->scene()));
    daylight_change_.reset();
    if (settings_.daylight != scene_daylight_)
    {
        HEARTH_ASSIGN_OR_RETURN(daylight_change_, gpu::changeDaylight(scene_->scene(), settings_.daylight));
        scene_daylight_ = settings_.daylight;
    }
    if (!shown_->assets.stage)
        return success();
    const size_t part = AssetViews::partIndex(asset_);
    HEARTH_ASSIGN_OR_RETURN(moves_, shown_->assets.stage->show(scene_->scene(), part, pose_.moves()));
    poses_ = shown_->assets.stage->poses(shown_->player, part);
    return success();
}

Status Viewer::resize()
{
    HEARTH_TRY(frames_->waitForAll());
    targets_.reset(); // they refer to the images
    HEARTH_TRY(swapchain_->resize(window_->extent()));
    resized_ = false;
    const VkExtent2D extent = swapchain_->extent();
    if (extent.width == 0)
        return success();
    const FrameSettings& frame = drawn_;
    HEARTH_ASSIGN_OR_RETURN(targets_,
                            renderer().createTargets(frame.render_size.value_or(extent),
                                                     {.gathers_light = scene_->scene().bricks != nullptr,
                                                      .may_bloom = needsBloomLevels(frame),
                                                      .output = extent,
                                                      .colors = swapchain_->callerImages(),
                                                      .light_paths = lightPaths(frame)}));
    return success();
}

void Viewer::buildPanel()
{
    imgui_->beginFrame();
    panel_.build(settings_, {.device = host_->deviceName(),
                             .extent = swapchain_->extent(),
                             .frame_seconds = frame_seconds_,
                             .figures = meter_->figures(),
                             .scene = *scene_,
                             .target_bytes = targets_->allocatedBytes(),
                             .camera = camera_,
                             .cameras = shown_->cameras,
                             .assets = shown_->assets.list,
                             .playback = shown_->playback,
                             .clips = shown_->clips,
                             .problem = problem_});
    imgui_->endFrame();
}

Result<bool> Viewer::drawFrame(bool panel, const gpu::Buffer* screenshot)
{
    if (!targets_)
        return false;
    HEARTH_TRY(frames_->wait());
    HEARTH_TRY(meter_->readSlot(frames_->slot()));
    HEARTH_ASSIGN_OR_RETURN(const std::optional<uint32_t> image, swapchain_->acquire(frames_->available()));
    if (!image)
    {
        resized_ = true;
        return false;
    }
    if (panel)
        buildPanel();
    HEARTH_TRY(poseScene());
    HEARTH_ASSIGN_OR_RETURN(const VkCommandBuffer commands, frames_->begin());
    recordFrame(commands, *image, panel, screenshot);
    HEARTH_TRY(frames_->submit(swapchain_->drawn(*image)));
    HEARTH_ASSIGN_OR_RETURN(const bool fits, swapchain_->present(*image));
    resized_ = resized_ || !fits;
    return true;
}

void Viewer::recordFrame(VkCommandBuffer commands, uint32_t image, bool panel, const gpu::Buffer* screenshot)
{
    gpu::Scene& scene = scene_->scene();
    if (scene.stream != nullptr)
        scene.stream->beginFrame(frames_->serial() + 1, frames_->completedSerial());
    gpu::FrameInput frame = makeFrame(drawn_, camera_.camera(), scene.instance_count, targets_->extent());
    if (frame.shading.post.automatic_exposure)
        frame.shading.post.automatic_exposure->time_step = static_cast<float>(frame_seconds_);
    frame.shadow_spheres = shadow_spheres_;
    frame.moves = moves_;
    frame.poses = poses_;
    frame.lights = lights_.changes();
    frame.lamp_weights = lamp_weights_.changes();
    frame.daylight = daylight_change_ ? &*daylight_change_ : nullptr;
    frame.timestamps = meter_->timestamps(frames_->slot());
    frame.color_image = image;
    renderer().record(commands, scene, *targets_, frame);
    meter_->record(commands, *scene_, frames_->slot(), settings_.count_culling);

    const gpu::Device& device = renderer_->device();
    const VkImage window = swapchain_->image(image);
    if (screenshot != nullptr)
        recordReadback(device, vk_, commands, window, swapchain_->extent(), *screenshot);
    if (panel)
        imgui_->record(commands, *swapchain_, image);
    else
        recordPresentable(device, commands, window);
}

Result<bool> Viewer::saveScreenshot(const std::string& file)
{
    const VkExtent2D extent = swapchain_->extent();
    const size_t size = size_t{extent.width} * extent.height * 4;
    gpu::MemoryArena arena(renderer_->device(), 0);
    HEARTH_ASSIGN_OR_RETURN(
        const gpu::Buffer buffer,
        arena.createBuffer(size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, gpu::MemoryKind::readback));
    HEARTH_ASSIGN_OR_RETURN(const bool drawn, drawFrame(false, &buffer));
    HEARTH_TRY(frames_->waitForAll());
    if (!drawn)
        return false;
    std::vector<std::byte> pixels(buffer.mapped, buffer.mapped + size);
    if (swapchain_->format() == VK_FORMAT_B8G8R8A8_SRGB)
        for (size_t i = 0; i < size; i += 4)
            std::swap(pixels[i], pixels[i + 2]);
    HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> png, encodePng(pixels, extent.width, extent.height));
    HEARTH_TRY(writeFile(file, png));
    return true;
}

bool Viewer::settledSince(uint64_t serial) const
{
    const gpu::SceneStream* stream = scene_->scene().stream.get();
    return stream == nullptr || stream->settledSerial() >= serial;
}

} // namespace hearth::viewer
