// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/viewer.h"

#include "runtime/viewer/camera_fit.h"
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

/// Fly speed in metres per second that reaches most of the scene in a few seconds: a quarter of the median
/// distance of the instances. Their bounds would include a sky dome.
float flySpeed(const formats::PackView& pack, Float3 eye)
{
    std::vector<float> distances;
    for (const formats::InstanceRecord& instance : pack.instances())
    {
        const formats::MeshRecord& mesh = pack.meshes()[instance.mesh];
        const Float3 center = (mesh.box_min + mesh.box_max) * 0.5f;
        distances.push_back(length(transformPoint(instance.world_from_object, center) - eye));
    }
    if (distances.empty())
        return 1;
    const auto median = distances.begin() + static_cast<ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), median, distances.end());
    return std::max(*median / 4, 1e-4f);
}

std::vector<NamedCamera> listCameras(const formats::PackView& pack, const pack::PosePlayer& player,
                                     const shared::Camera& start, float aspect)
{
    std::vector<NamedCamera> cameras{{"start", start}, {"whole scene", fitCamera(pack, player, aspect)}};
    for (uint32_t i = 0; i < pack.cameras().size(); ++i)
        if (pack.cameras()[i].type == static_cast<uint32_t>(formats::CameraType::perspective))
            cameras.push_back({"scene camera " + std::to_string(i), sceneCamera(pack, i)});
    return cameras;
}

std::vector<std::string> clipNames(const formats::PackView& pack)
{
    std::vector<std::string> names;
    for (const formats::AnimationRecord& animation : pack.animations())
    {
        const std::string_view name = pack.text(animation.name);
        names.push_back(name.empty() ? std::to_string(names.size()) : std::string(name));
    }
    return names;
}

/// The clip plays from its start, unless the command line sets a time.
PlaybackSettings playbackSettings(const AnimationSettings& options, const Playback& playback)
{
    PlaybackSettings settings;
    if (playback.clip())
        settings.clip = playback.clip()->animation;
    settings.playing = !options.seconds;
    return settings;
}

/// Fit the shadow options to flights between these cameras.
gpu::ShadowOptions fitShadowOptions(const ShadowSettings& settings, const formats::PackView& pack,
                                    std::span<const NamedCamera> named)
{
    std::vector<shared::Camera> cameras;
    for (const NamedCamera& camera : named)
        cameras.push_back(camera.camera);
    return fitShadows(settings, pack, cameras);
}

uint64_t geometryBytes(const formats::PackView& pack)
{
    uint64_t bytes = 0;
    for (const formats::PageRecord& page : pack.pages())
        bytes += page.size;
    return bytes;
}

} // namespace

Viewer::Viewer(const ViewOptions& options, const formats::PackView& pack, Playback playback,
               const pack::PosePlayer& player, const shared::Camera& start)
    : pack_(pack),
      settings_{.frame = options.settings,
                .playback = playbackSettings(options.animation, playback),
                .memory_budget = options.memory_budget},
      panel_(settings_, geometryBytes(pack)),
      camera_(start, flySpeed(pack, start.position)),
      clips_(clipNames(pack)),
      playback_(std::move(playback)),
      player_(pack),
      light_player_(pack),
      cameras_(listCameras(pack, player, start,
                           static_cast<float>(options.width) / static_cast<float>(options.height))),
      assets_(makeAssetViews(pack, player,
                             static_cast<float>(options.width) / static_cast<float>(options.height))),
      shadows_(fitShadowOptions(options.shadows, pack, cameras_)),
      shadow_spheres_(options.shadows.spheres)
{
}

Result<std::unique_ptr<Viewer>> Viewer::create(const ViewOptions& options, const formats::PackView& pack)
{
    HEARTH_TRY(checkPack(options, pack));
    HEARTH_ASSIGN_OR_RETURN(const std::optional<pack::ClipTime> clip, findClip(options.animation, pack));
    Playback playback(clipDurations(pack), clip, options.animation.seconds.value_or(0));
    pack::PosePlayer player(pack);
    playback.pose(player);
    HEARTH_ASSIGN_OR_RETURN(const shared::Camera start, chooseCamera(options, pack, player));
    std::unique_ptr<Viewer> viewer(new Viewer(options, pack, std::move(playback), player, start));
    HEARTH_ASSIGN_OR_RETURN(viewer->settings_.lamps, listLampControls(pack, options.lamps));
    viewer->settings_.daylight = options.daylight;
    HEARTH_TRY(viewer->open(options));
    return viewer;
}

Status Viewer::open(const ViewOptions& options)
{
    HEARTH_ASSIGN_OR_RETURN(window_,
                            SdlWindow::create("Hearth: " + pack_.name(), options.width, options.height));
    const HostWindow host_window = window_->hostWindow();
    HEARTH_ASSIGN_OR_RETURN(
        host_, VulkanHost::create(
                   {.device_name = options.device, .validate = options.validate, .window = &host_window}));
    // the panel offers the light methods of the path that the window begins with, and of simpler ones
    HEARTH_ASSIGN_OR_RETURN(renderer_,
                            gpu::Renderer::create(host_->description(), rendererOptions(settings_.frame)));
    HEARTH_TRY(renderer_->prepareOverdraw());
    HEARTH_ASSIGN_OR_RETURN(vk_, loadWindowTable(host_->description()));
    const gpu::Device& device = renderer_->device();
    HEARTH_ASSIGN_OR_RETURN(swapchain_, Swapchain::create(*host_, device, vk_));
    HEARTH_ASSIGN_OR_RETURN(frames_, FrameRing::create(*host_, device, vk_));
    HEARTH_ASSIGN_OR_RETURN(meter_, FrameMeter::create(*host_, device));
    HEARTH_ASSIGN_OR_RETURN(imgui_, ImguiLayer::create(*window_, *host_, device, *swapchain_));
    HEARTH_ASSIGN_OR_RETURN(scene_,
                            LoadedScene::load(*host_, *renderer_, pack_, settings_.memory_budget, shadows_));
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
    controls_.fly(camera_, static_cast<float>(std::clamp(seconds, 0.0, kMaxStep)));
    playback_.advance(settings_.playback, std::max(seconds, 0.0));
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
        camera_ = FlyCamera(cameras_[*settings_.camera].camera, camera_.speed());
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
        LoadedScene::load(*host_, renderer(), pack_, settings_.memory_budget, shadows_);
    problem_ = scene.ok() ? "" : formatMessage(scene.error());
    if (!scene.ok())
    {
        settings_.memory_budget = scene_->memoryBudget();
        return success();
    }
    return show(std::move(scene).value());
}

/// Replace the scene.
Status Viewer::show(std::unique_ptr<LoadedScene> scene)
{
    HEARTH_TRY(frames_->waitForAll());
    scene_ = std::move(scene);
    light_method_ = gpu::LightMethod::practical;
    HEARTH_TRY(prepareLightMethod());
    lights_ = FrameLights();
    lamp_weights_ = SceneLampWeights();
    scene_daylight_.reset();
    if (assets_.stage)
        assets_.stage->reset();
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
    options.deferred = options.deferred || renderer().supports(gpu::LightMethod::deferred);
    HEARTH_ASSIGN_OR_RETURN(std::unique_ptr<gpu::Renderer> renderer,
                            gpu::Renderer::create(host_->description(), options));
    HEARTH_TRY(renderer->prepareOverdraw());
    HEARTH_ASSIGN_OR_RETURN(std::unique_ptr<LoadedScene> scene,
                            LoadedScene::load(*host_, *renderer, pack_, scene_->memoryBudget(), shadows_));
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
    const shared::Camera& camera = asset_ ? assets_.list[*asset_].camera : cameras_[1].camera;
    const float speed =
        asset_ ? length(camera.position - camera.target) / 4 : flySpeed(pack_, camera.position);
    camera_ = FlyCamera(camera, speed);
}

/// Compute the moves, poses and lights of the next frame, for the clip and the shown asset.
Status Viewer::poseScene()
{
    playback_.pose(player_);
    HEARTH_TRY(pose_.take(player_, scene_->scene()));
    moves_.assign(pose_.moves().begin(), pose_.moves().end());
    poses_ = pose_.poses();
    light_player_.update(player_, playback_.flickerSeconds());
    lights_.clear();
    HEARTH_TRY(lights_.add(light_player_, scene_->scene()));
    HEARTH_TRY(lamp_weights_.update(settings_.lamps, scene_->scene()));
    daylight_change_.reset();
    if (settings_.daylight != scene_daylight_)
    {
        HEARTH_ASSIGN_OR_RETURN(daylight_change_, gpu::changeDaylight(scene_->scene(), settings_.daylight));
        scene_daylight_ = settings_.daylight;
    }
    if (!assets_.stage)
        return success();
    const size_t part = AssetViews::partIndex(asset_);
    HEARTH_ASSIGN_OR_RETURN(moves_, assets_.stage->show(scene_->scene(), part, pose_.moves()));
    poses_ = assets_.stage->poses(player_, part);
    return success();
}

Status Viewer::resize()
{
    HEARTH_TRY(frames_->waitForAll());
    HEARTH_TRY(swapchain_->resize(window_->extent()));
    resized_ = false;
    const VkExtent2D extent = swapchain_->extent();
    targets_.reset();
    if (extent.width == 0)
        return success();
    const FrameSettings& frame = drawn_;
    HEARTH_ASSIGN_OR_RETURN(targets_,
                            renderer().createTargets(frame.render_size.value_or(extent),
                                                     {.gathers_light = scene_->scene().bricks != nullptr,
                                                      .may_bloom = needsBloomLevels(frame),
                                                      .output = extent,
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
                             .cameras = cameras_,
                             .assets = assets_.list,
                             .playback = playback_,
                             .clips = clips_,
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
    renderer().record(commands, scene, *targets_, frame);
    meter_->record(commands, *scene_, frames_->slot(), settings_.count_culling);

    const gpu::Device& device = renderer_->device();
    const VkImage window = swapchain_->image(image);
    recordImage(device, vk_, commands, *targets_, window);
    if (panel)
        imgui_->record(commands, *swapchain_, image);
    else
        recordWithoutOverlay(device, commands, window);
    if (screenshot != nullptr)
        recordReadback(device, vk_, commands, window, swapchain_->extent(), *screenshot);
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
