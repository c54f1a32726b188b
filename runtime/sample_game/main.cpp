// The sample game: one walks about a camp, by day and by night. README.md is its guide.
//   game PACK [--size WIDTHxHEIGHT]    in a window
//   game PACK --replay FILE --frames N [--every K] [--size WIDTHxHEIGHT] -o FOLDER
//                                      without one: pictures of each K-th frame of a recording
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "day.h"
#include "hero.h"
#include "particles.h"
#include "picture.h"
#include "screen.h"
#include "world.h"

#include <SDL.h>
#include <algorithm>
#include <backends/imgui_impl_sdl.h>
#include <backends/imgui_impl_vulkan.h>
#include <filesystem>
#include <imgui.h>

namespace game
{

namespace
{

struct Options
{
    std::string pack, recording, folder;
    uint32_t width = 1280, height = 720;
    uint32_t frames = 0, every = 1;
};

Options readOptions(int count, char** arguments)
{
    Options options;
    bool is_good = count > 1 && count % 2 == 0;
    options.pack = count > 1 ? arguments[1] : "";
    for (int i = 2; i + 1 < count && is_good; i += 2)
    {
        const std::string name = arguments[i];
        const char* const value = arguments[i + 1];
        if (name == "--replay")
            options.recording = value;
        else if (name == "-o")
            options.folder = value;
        else if (name == "--frames")
            is_good = std::sscanf(value, "%u", &options.frames) == 1;
        else if (name == "--every")
            is_good = std::sscanf(value, "%u", &options.every) == 1 && options.every > 0;
        else if (name == "--size")
            is_good = std::sscanf(value, "%ux%u", &options.width, &options.height) == 2;
        else
            is_good = false;
    }
    is_good = is_good && options.recording.empty() == options.folder.empty() &&
              options.recording.empty() == (options.frames == 0);
    check(is_good, "usage: game PACK [--size WIDTHxHEIGHT] [--replay FILE --frames N [--every K] -o FOLDER]");
    return options;
}

/// All that both ways to play share.
struct Game
{
    hearth::Pack pack;
    Day day;
    Hero hero;
    World world;
    Particles particles;
    hearth_frame frame = HEARTH_FRAME_INIT;

    Game(Gpu& gpu, const Options& options)
        : pack(open(options.pack)),
          day(pack),
          hero(pack),
          world(gpu, pack, options.width, options.height, !options.recording.empty()),
          particles(gpu, world.images())
    {
        for (int i = 0; i < 60; ++i) // the fire burns already
            particles.step(0.033f);
    }

    static hearth::Pack open(const std::string& path)
    {
        hearth::Pack pack;
        std::string why;
        check(hearth::Pack::open(path, pack, &why), why);
        return pack;
    }

    void step(const Input& input, float seconds)
    {
        hero.step(input, seconds);
        particles.step(seconds);
        hero.show(frame);
        day.light(frame);
    }

    void record(VkCommandBuffer commands)
    {
        world.record(commands, frame);
        particles.record(commands, frame.camera);
    }
};

void replay(Gpu& gpu, const Options& options)
{
    constexpr float kFrameSeconds = 1 / 30.0f;
    const Recording recording(options.recording);
    Game game(gpu, options);
    Picture picture(gpu, options.width, options.height);
    std::error_code error;
    std::filesystem::create_directories(options.folder, error);
    check(!error, options.folder + ": " + error.message());
    for (uint32_t i = 0; i < options.frames; ++i)
    {
        game.step(recording.at(i, game.day.hour), kFrameSeconds);
        if (i % options.every != 0)
            continue;
        if (i == 0)
            game.world.prefetch(game.frame);
        const VkCommandBuffer commands = gpu.begin();
        game.record(commands);
        picture.record(commands, game.world.images().color.image);
        gpu.submit();
        gpu.waitForAll();
        char name[32];
        std::snprintf(name, sizeof(name), "/%04u.png", i);
        picture.write(options.folder + name);
    }
}

/// Draw the menu; return whether the game goes on.
bool drawMenu(Game& game, float& hours_a_minute)
{
    const hearth_stream_counters stream = game.world.counters();
    ImGui::SetNextWindowPos({16, 16}, ImGuiCond_Once);
    ImGui::Begin("Camp", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::SliderFloat("hour", &game.day.hour, 0, 24, "%.1f");
    ImGui::SliderFloat("hours a minute", &hours_a_minute, 0, 12, "%.1f");
    ImGui::SliderFloat("pixels of error", &game.frame.error_pixels, 0.5f, 8, "%.1f");
    ImGui::Text("%.1f MiB of geometry and textures, %.0f frames a second",
                static_cast<double>(stream.bytes_in_use + stream.texture_bytes_in_use) / 1048576,
                static_cast<double>(ImGui::GetIO().Framerate));
    ImGui::TextUnformatted(
        "W A S D, left stick: walk; arrows, right stick: look; Shift, RB: run; F, Y: wave");
    const bool goes_on = !ImGui::Button("Quit");
    ImGui::End();
    return goes_on;
}

void play(Gpu& gpu, SDL_Window* window, const Options& options)
{
    Game game(gpu, options);
    Screen screen(gpu, window);
    float hours_a_minute = 1;
    bool goes_on = true, has_menu = false;
    uint64_t last = SDL_GetPerformanceCounter();
    while (goes_on)
    {
        for (SDL_Event event; SDL_PollEvent(&event) != 0;)
        {
            ImGui_ImplSDL2_ProcessEvent(&event);
            goes_on &= event.type != SDL_QUIT;
            const bool is_key = event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE;
            const bool is_button =
                event.type == SDL_CONTROLLERBUTTONDOWN && event.cbutton.button == SDL_CONTROLLER_BUTTON_START;
            has_menu ^= is_key || is_button;
        }
        ImGui_ImplVulkan_NewFrame();
        ImGui_ImplSDL2_NewFrame();
        ImGui::NewFrame();
        if (has_menu)
            goes_on &= drawMenu(game, hours_a_minute);
        ImGui::Render();

        const uint64_t now = SDL_GetPerformanceCounter();
        const float seconds = std::min(
            static_cast<float>(now - last) / static_cast<float>(SDL_GetPerformanceFrequency()), 0.1f);
        last = now;
        game.day.hour = std::fmod(game.day.hour + hours_a_minute * seconds / 60, 24.0f);
        game.step(has_menu ? Input() : readDevices(), seconds);
        const std::optional<uint32_t> image = screen.acquire();
        if (!image)
            continue;
        const VkCommandBuffer commands = gpu.begin();
        game.record(commands);
        screen.record(commands, *image, game.world.images().color.image, {options.width, options.height});
        screen.show(*image);
    }
    gpu.waitForAll();
}

} // namespace

} // namespace game

int main(int argument_count, char** arguments)
{
    using namespace game;
    const Options options = readOptions(argument_count, arguments);
    const bool is_replay = !options.recording.empty();
    SDL_Window* window = nullptr;
    if (!is_replay)
    {
        check(SDL_Init(SDL_INIT_VIDEO | SDL_INIT_GAMECONTROLLER) == 0, SDL_GetError());
        window = SDL_CreateWindow("Camp", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                                  static_cast<int>(options.width), static_cast<int>(options.height),
                                  SDL_WINDOW_VULKAN | SDL_WINDOW_RESIZABLE);
        check(window != nullptr, SDL_GetError());
    }
    Gpu gpu(window);
    if (is_replay)
        replay(gpu, options);
    else
        play(gpu, window, options);
    return 0;
}
