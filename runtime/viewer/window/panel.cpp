// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/panel.h"

#include "runtime/gpu/textures/streamed_textures.h"

#include <algorithm>
#include <imgui.h>

namespace hearth::viewer
{

namespace
{

constexpr uint64_t kMib = uint64_t{1} << 20;
constexpr float kMaxError = 64;    // pixels: coarser than anybody wants to see
constexpr float kLabelWidth = 135; // pixels: the longest is "Specular occlusion"

double mib(uint64_t bytes)
{
    return static_cast<double>(bytes) / static_cast<double>(kMib);
}

/// Show a choice between named values.
template <typename T>
void chooseNamed(const char* label, std::span<const Named<T>> choices, T& value)
{
    const auto current =
        std::find_if(choices.begin(), choices.end(), [&](const Named<T>& c) { return c.value == value; });
    if (!ImGui::BeginCombo(label, current == choices.end() ? "" : current->name))
        return;
    for (const Named<T>& choice : choices)
        if (ImGui::Selectable(choice.name, choice.value == value))
            value = choice.value;
    ImGui::EndCombo();
}

void showProblem(const std::string& problem)
{
    if (problem.empty())
        return;
    ImGui::PushStyleColor(ImGuiCol_Text, {1.0f, 0.2f, 0.1f, 1.0f});
    ImGui::TextWrapped("%s", problem.c_str());
    ImGui::PopStyleColor();
}

void showCount(const char* name, uint64_t count)
{
    ImGui::Text("%-16s %12llu", name, static_cast<unsigned long long>(count));
}

void showTimes(const FrameStatistics& figures)
{
    constexpr const char* kPasses[] = {"frame",   "shadows",   "cull",       "early visibility",
                                       "pyramid", "late cull", "visibility", "material tiles",
                                       "shading"};
    static_assert(std::size(kPasses) == gpu::kTimestampCount);
    if (!ImGui::CollapsingHeader("Times on the device"))
        return;
    for (size_t pass = 0; pass < figures.milliseconds.size(); ++pass)
        ImGui::Text("%-16s %9.3f ms", kPasses[pass], figures.milliseconds[pass]);
}

void chooseCamera(ViewSettings& settings, const PanelData& facts)
{
    if (!ImGui::BeginCombo("Camera", "go to ..."))
        return;
    for (size_t i = 0; i < facts.cameras.size(); ++i)
        if (ImGui::Selectable(facts.cameras[i].name.c_str()))
            settings.camera = i;
    ImGui::EndCombo();
}

void chooseAsset(ViewSettings& settings, std::span<const AssetView> assets)
{
    if (assets.empty() || !ImGui::CollapsingHeader("Assets", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    constexpr size_t kRows = 8;
    const float height =
        static_cast<float>(std::min(assets.size() + 1, kRows)) * ImGui::GetTextLineHeightWithSpacing();
    if (!ImGui::BeginListBox("##assets", {-1, height}))
        return;
    if (ImGui::Selectable("whole scene", !settings.asset))
        settings.asset.reset();
    for (size_t i = 0; i < assets.size(); ++i)
    {
        ImGui::PushID(static_cast<int>(i)); // several may have one name
        if (ImGui::Selectable(assets[i].name.c_str(), settings.asset == i))
            settings.asset = i;
        ImGui::PopID();
    }
    ImGui::EndListBox();
}

void chooseClip(PlaybackSettings& settings, std::span<const std::string> clips)
{
    constexpr const char* kRest = "none: at rest";
    if (!ImGui::BeginCombo("Clip", settings.clip ? clips[*settings.clip].c_str() : kRest))
        return;
    if (ImGui::Selectable(kRest, !settings.clip))
        settings.clip.reset();
    for (uint32_t i = 0; i < clips.size(); ++i)
    {
        ImGui::PushID(static_cast<int>(i)); // several may have one name
        if (ImGui::Selectable(clips[i].c_str(), settings.clip == i))
            settings.clip = i;
        ImGui::PopID();
    }
    ImGui::EndCombo();
}

void showClip(PlaybackSettings& settings, const PanelData& facts)
{
    const std::optional<pack::ClipTime> clip = facts.playback.clip();
    if (!clip)
        return;
    double seconds = clip->seconds;
    const double first = 0, last = facts.playback.duration(clip->animation);
    if (ImGui::SliderScalar("Time", ImGuiDataType_Double, &seconds, &first, &last, "%.3f s",
                            ImGuiSliderFlags_AlwaysClamp))
        settings.go_to = seconds;
    if (const std::optional<pack::ClipTime> faded_clip = facts.playback.fadedClip())
        ImGui::Text("%.0f %% of it, the rest %s", facts.playback.weight() * 100,
                    facts.clips[faded_clip->animation].c_str());
}

void buildAnimation(PlaybackSettings& settings, const PanelData& facts)
{
    if (facts.clips.empty() || !ImGui::CollapsingHeader("Animation", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    constexpr float kFastest = 4, kLongestFade = 2;
    chooseClip(settings, facts.clips);
    showClip(settings, facts);
    ImGui::Checkbox("Play", &settings.playing);
    ImGui::SameLine();
    ImGui::Checkbox("Loop", &settings.loop);
    ImGui::SliderFloat("Speed", &settings.speed, -kFastest, kFastest, "%.2f", ImGuiSliderFlags_AlwaysClamp);
    ImGui::SliderFloat("Fade", &settings.fade_seconds, 0, kLongestFade, "%.2f s",
                       ImGuiSliderFlags_AlwaysClamp);
}

/// Show the weights of lamps, of their live light and of what is baked of it.
void buildLamps(std::vector<LampControl>& lamps)
{
    if (lamps.empty() || !ImGui::CollapsingHeader("Lamps"))
        return;
    constexpr float kMaxBrightness = 4;
    constexpr size_t kMaxRows = 200;
    if (ImGui::SmallButton("all as they were"))
        for (LampControl& lamp : lamps)
            lamp = {.lamp = lamp.lamp};
    for (size_t i = 0; i < std::min(lamps.size(), kMaxRows); ++i)
    {
        LampControl& lamp = lamps[i];
        ImGui::PushID(static_cast<int>(i)); // several may have one name
        float color[] = {lamp.color.x, lamp.color.y, lamp.color.z};
        if (ImGui::ColorEdit3("##color", color, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_Float))
            lamp.color = {color[0], color[1], color[2]};
        ImGui::SameLine();
        const std::string name(lamp.lamp.name.empty() ? std::string_view("lamp without name")
                                                      : lamp.lamp.name);
        ImGui::SliderFloat(name.c_str(), &lamp.brightness, 0, kMaxBrightness, "%.2f",
                           ImGuiSliderFlags_AlwaysClamp);
        ImGui::PopID();
    }
}

/// Show the daylight, in scenes whose sky is no image.
void buildDaylight(std::optional<shared::Daylight>& daylight, const gpu::Scene& scene)
{
    if (scene.lights->hasSkyImage() || !ImGui::CollapsingHeader("Daylight"))
        return;
    bool is_on = daylight.has_value();
    if (ImGui::Checkbox("Clear sky in place of the scene's", &is_on))
        daylight = is_on ? std::optional(shared::Daylight{}) : std::nullopt;
    if (!daylight)
        return;
    ImGui::SliderFloat("Elevation", &daylight->elevation_deg, 0, 90, "%.1f deg",
                       ImGuiSliderFlags_AlwaysClamp);
    ImGui::SliderFloat("Azimuth", &daylight->azimuth_deg, -180, 180, "%.1f deg",
                       ImGuiSliderFlags_AlwaysClamp);
    ImGui::SliderFloat("Haze", &daylight->turbidity, 2.5f, 8, "%.1f", ImGuiSliderFlags_AlwaysClamp);
}

/// Show the settings of what follows the lighting; zero everywhere is none.
void buildPost(gpu::PostSettings& post)
{
    if (!ImGui::CollapsingHeader("Exposure, bloom, photo filter"))
        return;
    constexpr float kMaxStops = 8; // a factor of 256: the command line takes more
    ImGui::SliderFloat("Exposure", &post.exposure_stops, -kMaxStops, kMaxStops, "%.2f stops",
                       ImGuiSliderFlags_AlwaysClamp);
    bool is_automatic = post.automatic_exposure.has_value();
    if (ImGui::Checkbox("Follow the light of the image", &is_automatic))
        post.automatic_exposure =
            is_automatic ? std::optional(gpu::AutomaticExposure{}) : std::optional<gpu::AutomaticExposure>();
    ImGui::SliderFloat("Bloom", &post.bloom.strength, 0, 1, "%.3f",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    bool adds = post.bloom.mode == gpu::BloomMode::add;
    if (ImGui::Checkbox("Add bloom, take nothing away", &adds))
        post.bloom.mode = adds ? gpu::BloomMode::add : gpu::BloomMode::mix;
    // linear, as all colours of the window
    Float3& glass = post.photo_filter.color;
    float color[] = {glass.x, glass.y, glass.z};
    if (ImGui::ColorEdit3("Photo filter", color, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_Float))
        glass = {color[0], color[1], color[2]};
    ImGui::SliderFloat("Density", &post.photo_filter.density, 0, 1, "%.2f", ImGuiSliderFlags_AlwaysClamp);
}

} // namespace

Panel::Panel(const ViewSettings& settings, uint64_t geometry_bytes)
    : streamed_(settings.memory_budget > 0), curve_(settings.frame.lod_curve)
{
    // slots are larger than their pages: half as much again holds everything
    const uint64_t max_budget =
        std::clamp(geometry_bytes * 3 / 2 / kMib + 1, uint64_t{16}, uint64_t{1} << 20);
    max_budget_mib_ = static_cast<int>(max_budget);
    const uint64_t budget = settings.memory_budget / kMib;
    budget_mib_ = streamed_ ? static_cast<int>(std::clamp(budget, uint64_t{1}, max_budget)) : max_budget_mib_;
}

void Panel::build(ViewSettings& settings, const PanelData& facts)
{
    ImGui::SetNextWindowPos({10, 10}, ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize({380, 560}, ImGuiCond_FirstUseEver);
    if (ImGui::Begin("Hearth"))
    {
        ImGui::PushItemWidth(-kLabelWidth);
        ImGui::Text("%s, %u x %u", facts.device.c_str(), facts.extent.width, facts.extent.height);
        ImGui::Text("%.2f ms a frame, %.3g m/s", facts.frame_seconds * 1e3,
                    static_cast<double>(facts.camera.speed()));
        if (const uint32_t dropped = facts.scene.scene().dropped_lights; dropped > 0)
            showProblem(std::to_string(dropped) + " lights are more than can be drawn");
        chooseCamera(settings, facts);
        chooseAsset(settings, facts.assets);
        buildImage(settings.frame, facts);
        buildDaylight(settings.daylight, facts.scene.scene());
        buildLamps(settings.lamps);
        buildPost(settings.frame.post);
        buildAnimation(settings.playback, facts);
        buildCurve(settings.frame);
        buildStreaming(settings, facts);
        buildCulling(settings, facts);
        showTimes(facts.figures);
        ImGui::PopItemWidth();
    }
    ImGui::End();
}

void Panel::buildImage(FrameSettings& settings, const PanelData& facts)
{
    const gpu::Scene& scene = facts.scene.scene();
    std::vector<Named<uint32_t>> views;
    for (const Named<uint32_t>& view : viewNames())
        if ((scene.shadows != nullptr || view.value != shared::kViewShadowMaps) &&
            (scene.bricks != nullptr || !shared::viewNeedsBricks(view.value)))
            views.push_back(view);
    chooseNamed("View", std::span<const Named<uint32_t>>(views), settings.view);
    if (scene.bricks != nullptr)
        ImGui::Checkbox("Light of bricks", &settings.gi);
    ImGui::SliderFloat("Error, pixels", &settings.error_pixels, 0, kMaxError, "%.2f",
                       ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    chooseNamed("Shaded area", shadedAreaNames(), settings.shaded_area);
    chooseNamed("Lights", lightMethodNames(), settings.light_method);
    chooseNamed("Lists of lights", lightListerNames(), settings.light_lister);
    if (gpu::hasSkyVisibility(scene))
    {
        chooseNamed("Ambient occlusion", ambientOcclusionNames(), settings.ambient_occlusion);
        chooseNamed("Specular occlusion", specularOcclusionNames(), settings.specular_occlusion);
    }
}

void Panel::buildCurve(FrameSettings& settings)
{
    if (!ImGui::CollapsingHeader("Distance curve"))
        return;
    ImGui::TextUnformatted("metres, factor on the error");
    bool changed = false;
    for (size_t i = 0; i < curve_.size(); ++i)
    {
        ImGui::PushID(static_cast<int>(i));
        ImGui::SetNextItemWidth(120);
        changed |= ImGui::DragFloat("##distance", &curve_[i].distance, 0.1f, 0, 1e6f, "%.2f m");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(120);
        changed |= ImGui::DragFloat("##factor", &curve_[i].factor, 0.01f, 0, 100, "%.3f");
        ImGui::SameLine();
        const bool removed = ImGui::SmallButton("remove");
        ImGui::PopID();
        if (removed)
        {
            curve_.erase(curve_.begin() + static_cast<ptrdiff_t>(i));
            changed = true;
            break; // the other rows appear again in the next frame
        }
    }
    if (curve_.size() < shared::kMaxLodKnots && ImGui::SmallButton("add a knot"))
    {
        const shared::LodKnot last = curve_.empty() ? shared::LodKnot{0, 1} : curve_.back();
        curve_.push_back({curve_.empty() ? 0 : last.distance * 2 + 1, last.factor});
        changed = true;
    }
    if (changed)
    {
        shared::FrameView scratch{};
        const Status valid = shared::setLodCurve(scratch, curve_);
        curve_problem_ = valid.ok() ? "" : valid.error().detail;
        if (valid.ok())
            settings.lod_curve = curve_;
    }
    showProblem(curve_problem_);
}

void Panel::buildStreaming(ViewSettings& settings, const PanelData& facts)
{
    if (!ImGui::CollapsingHeader("Memory", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    bool changed = ImGui::Checkbox("Stream geometry and textures", &streamed_);
    if (streamed_)
    {
        ImGui::SliderInt("Budget", &budget_mib_, 1, max_budget_mib_, "%d MiB",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
        // the scene is reloaded, so once per drag and not for every pixel of it
        changed |= ImGui::IsItemDeactivatedAfterEdit();
    }
    if (changed)
        settings.memory_budget = streamed_ ? static_cast<uint64_t>(budget_mib_) * kMib : 0;
    showProblem(facts.problem);
    ImGui::Text("scene %.1f MiB, attachments %.1f MiB", mib(facts.scene.bytes()), mib(facts.target_bytes));
    const gpu::SceneStream* stream = facts.scene.scene().stream.get();
    if (stream == nullptr)
        return;
    const pack::StreamStatistics& s = stream->statistics();
    ImGui::Text("resident %.1f MiB in %u pages", mib(s.bytes_resident), s.pages_resident);
    ImGui::Text("in use %.1f of %.1f MiB, streamed %.1f MiB", mib(s.bytes_in_use), mib(s.budget_bytes),
                mib(s.bytes_streamed));
    ImGui::Text("error scale %.2f, %u reads under way, %u failures", static_cast<double>(s.error_scale),
                stream->pages().readsInFlight(), s.failures);
    if (stream->textures() == nullptr)
        return;
    const gpu::TextureStatistics t = stream->textures()->statistics();
    ImGui::Text("textures: in use %.1f of %.1f MiB, on the device %.1f MiB, streamed %.1f MiB",
                mib(t.bytes_in_use), mib(t.budget_bytes), mib(t.bytes_on_device), mib(t.bytes_streamed));
    ImGui::Text("texels a pixel %.2f, %u reads under way, %u failures",
                1 / static_cast<double>(t.error_scale), stream->textures()->stream().readsInFlight(),
                t.failures);
}

void Panel::buildCulling(ViewSettings& settings, const PanelData& facts)
{
    if (!ImGui::CollapsingHeader("Culling", ImGuiTreeNodeFlags_DefaultOpen))
        return;
    for (const Named<uint32_t>& test : cullTestNames())
    {
        ImGui::CheckboxFlags(test.name, &settings.frame.cull_flags, test.value);
        ImGui::SameLine();
    }
    ImGui::NewLine();
    ImGui::Checkbox("Hide by an earlier frame's depth only", &settings.frame.occludes_by_last_frame);
    const FrameStatistics& figures = facts.figures;
    showCount("clusters drawn", figures.counters.drawn_clusters);
    showCount("of these early", figures.counters.early_clusters);
    if (figures.counters.dropped_clusters > 0)
        showCount("without a slot", figures.counters.dropped_clusters);
    ImGui::Checkbox("Count what each test leaves out", &settings.count_culling);
    if (!figures.culling)
        return;
    const CullCounts& clusters = figures.culling->clusters;
    showCount("tested", clusters.tested);
    showCount("hidden instance", clusters.instance);
    showCount("not in the cut", clusters.lod);
    showCount("outside", clusters.frustum);
    showCount("facing away", clusters.cone);
    showCount("occluded", clusters.occlusion);
}

} // namespace hearth::viewer
