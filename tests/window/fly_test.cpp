// Tests the fly camera and its keyboard and mouse controls. No window is needed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/fly_controls.h"

#include <SDL.h>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using viewer::FlyCamera;
using viewer::FlyControls;

shared::Camera level()
{
    return {.position = {1, 2, 3}, .target = {1, 2, -7}};
}

Float3 getDirection(const FlyCamera& camera)
{
    return normalizeOr(camera.camera().target - camera.camera().position, {});
}

void expectNear(Float3 a, Float3 b)
{
    EXPECT_LT(length(a - b), 1e-4f) << a.x << ' ' << a.y << ' ' << a.z;
}

SDL_Event key(SDL_Scancode code, uint32_t type)
{
    SDL_Event event{};
    event.type = type;
    event.key.keysym.scancode = code;
    return event;
}

SDL_Event rightButton(uint32_t type)
{
    SDL_Event event{};
    event.type = type;
    event.button.button = SDL_BUTTON_RIGHT;
    return event;
}

SDL_Event motion(int x, int y)
{
    SDL_Event event{};
    event.type = SDL_MOUSEMOTION;
    event.motion.xrel = x;
    event.motion.yrel = y;
    return event;
}

} // namespace

TEST(FlyCamera, isTheCameraItStartedAsUntilItMoves)
{
    const shared::Camera start{{0.1f, 0.2f, 0.3f}, {7, 5, 3}, {0.1f, 0.9f, 0}, 0.7f, 0.02f};
    FlyCamera camera(start, 5);
    camera.fly({}, 1);
    camera.fly({0, 0, 1}, 0);
    camera.changeSpeed(1);
    EXPECT_EQ(camera.camera().position, start.position);
    EXPECT_EQ(camera.camera().target, start.target);
    EXPECT_EQ(camera.camera().up, start.up);
    EXPECT_EQ(camera.camera().z_near, start.z_near);
}

TEST(FlyCamera, fliesAtItsSpeedAndTakesTheTargetAlong)
{
    FlyCamera camera(level(), 2);
    camera.fly({0, 0, 1}, 1.5f);
    expectNear(camera.camera().position, {1, 2, 0});
    expectNear(camera.camera().target, {1, 2, -10});
    camera.fly({1, 0, 0}, 1);
    expectNear(camera.camera().position, {3, 2, 0});
    camera.fly({0, -1, 0}, 1);
    expectNear(camera.camera().position, {3, 0, 0});
}

TEST(FlyCamera, looksToTheRightAndUp)
{
    FlyCamera camera(level(), 1);
    camera.look(1.5707963f, 0);
    expectNear(getDirection(camera), {1, 0, 0});
    camera.look(0, 0.5f);
    EXPECT_NEAR(getDirection(camera).y, std::sin(0.5f), 1e-5f);
    EXPECT_NEAR(length(camera.camera().target - camera.camera().position), 10, 1e-4f);
    camera.look(0, 100);
    EXPECT_LT(getDirection(camera).y, 1) << "what is to the right stays defined";
    EXPECT_GT(getDirection(camera).y, 0.999f);
}

TEST(FlyCamera, turnsFromStraightDownToWhereItsTopPoints)
{
    FlyCamera camera({.position = {0, 5, 0}, .target = {0, 0, 0}, .up = {1, 0, 0}}, 1);
    camera.look(0, 1.5707963f);
    EXPECT_GT(getDirection(camera).x, 0.99f);
}

TEST(FlyControls, flyWhileAKeyIsHeld)
{
    FlyCamera camera(level(), 1);
    FlyControls controls;
    controls.handle(key(SDL_SCANCODE_W, SDL_KEYDOWN), {}, camera);
    controls.handle(key(SDL_SCANCODE_D, SDL_KEYDOWN), {}, camera);
    controls.fly(camera, 1);
    expectNear(camera.camera().position, {2, 2, 2});
    controls.handle(key(SDL_SCANCODE_W, SDL_KEYUP), {}, camera);
    controls.handle(key(SDL_SCANCODE_LSHIFT, SDL_KEYDOWN), {}, camera);
    controls.fly(camera, 1);
    expectNear(camera.camera().position, {6, 2, 2});
    SDL_Event left{};
    left.type = SDL_WINDOWEVENT;
    left.window.event = SDL_WINDOWEVENT_FOCUS_LOST;
    controls.handle(left, {}, camera);
    controls.fly(camera, 1);
    expectNear(camera.camera().position, {6, 2, 2});
}

TEST(FlyControls, leaveThePanelWhatItKeeps)
{
    FlyCamera camera(level(), 1);
    FlyControls controls;
    controls.handle(key(SDL_SCANCODE_W, SDL_KEYDOWN), {.keys = true}, camera);
    controls.fly(camera, 1);
    controls.handle(rightButton(SDL_MOUSEBUTTONDOWN), {.mouse = true}, camera);
    controls.handle(motion(100, 0), {}, camera);
    SDL_Event wheel{};
    wheel.type = SDL_MOUSEWHEEL;
    wheel.wheel.y = 3;
    controls.handle(wheel, {.mouse = true}, camera);
    EXPECT_EQ(camera.camera().position, level().position);
    EXPECT_EQ(camera.camera().target, level().target);
    EXPECT_EQ(camera.speed(), 1);
}

TEST(FlyControls, lookWhileTheRightButtonIsHeld)
{
    FlyCamera camera(level(), 1);
    FlyControls controls;
    controls.handle(motion(100, 0), {}, camera);
    EXPECT_EQ(camera.camera().target, level().target);
    controls.handle(rightButton(SDL_MOUSEBUTTONDOWN), {}, camera);
    controls.handle(motion(100, -50), {}, camera);
    EXPECT_GT(getDirection(camera).x, 0.1f);
    EXPECT_GT(getDirection(camera).y, 0.1f);
    controls.handle(rightButton(SDL_MOUSEBUTTONUP), {}, camera);
    const Float3 direction = getDirection(camera);
    controls.handle(motion(100, 100), {}, camera);
    EXPECT_EQ(getDirection(camera), direction);
}

} // namespace hearth::test
