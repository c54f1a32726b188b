// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "hero.h"

#include <algorithm>

namespace game
{

namespace
{

constexpr float kWalkSpeed = 1.5f, kRunSpeed = 3.8f; ///< metres a second
constexpr float kRadius = 0.35f, kStep = 0.5f;       ///< of the body; of the highest step; metres
constexpr float kHead = 1.45f;                       ///< height that the camera looks at, metres

} // namespace

Hero::Hero(const hearth::Pack& pack)
{
    std::string why;
    const hearth_queries_options options = HEARTH_QUERIES_OPTIONS_INIT;
    check(hearth::Queries::create(pack, options, queries_, &why), why);
    check(hearth::Player::create(pack, player_, &why), why);
    idle_ = findClip(pack, "idle");
    walk_ = findClip(pack, "walk");
    run_ = findClip(pack, "run");
    wave_ = findClip(pack, "wave");
    check(pack.findRecord(HEARTH_TABLE_MESHES, "mannequin", passable_[0], 0, &why), why);
    check(pack.findRecord(HEARTH_TABLE_MESHES, "grass_tuft", passable_[1], 0, &why), why);
    step({}, 0);
}

Hero::Clip Hero::findClip(const hearth::Pack& pack, const char* name)
{
    Clip clip{};
    char why[256] = "";
    check(hearth_pack_find_animation(pack.get(), name, &clip.animation, &clip.seconds, why, sizeof(why)),
          why);
    return clip;
}

float Hero::castRay(Vec origin, Vec direction, float reach)
{
    hearth_cast cast = HEARTH_CAST_INIT;
    cast.user = passable_;
    cast.accept = [](void* passable, const hearth_hit* hit)
    {
        const auto* const meshes = static_cast<const uint32_t*>(passable);
        return static_cast<int>(hit->mesh != meshes[0] && hit->mesh != meshes[1]);
    };
    const hearth_ray ray{{origin.x, origin.y, origin.z}, {direction.x, direction.y, direction.z}, 0, reach};
    hearth_hit hit;
    std::string why;
    check(queries_.castRay(ray, hit, &cast, &why), why);
    return hit.instance == UINT32_MAX ? reach : hit.t;
}

void Hero::walk(Vec way, float seconds)
{
    // along walls, axis by axis
    for (const Vec axis : {Vec{way.x, 0, 0}, Vec{0, 0, way.z}})
    {
        const float length = std::sqrt(dot(axis, axis)) * seconds;
        if (length == 0)
            continue;
        const Vec direction = unit(axis);
        if (castRay(position_ + Vec{0, kStep, 0}, direction, length + kRadius) == length + kRadius)
            position_ = position_ + direction * length;
    }
    // the ground is where a ray from the highest step meets it; one falls no deeper than two metres a frame
    position_.y += kStep - castRay(position_ + Vec{0, kStep, 0}, {0, -1, 0}, 2 + kStep);
}

void Hero::step(const Input& input, float seconds)
{
    camera_heading_ -= 2.2f * input.turn * seconds;
    camera_tilt_ = std::clamp(camera_tilt_ - 1.2f * input.tilt * seconds, -0.15f, 1.1f);

    const Vec ahead = headingToDirection(camera_heading_), right = cross(ahead, {0, 1, 0});
    const Vec wish = ahead * input.forward + right * input.right;
    const float strength = std::fmin(1.0f, std::sqrt(dot(wish, wish)));
    const float wanted = strength * (input.is_running ? kRunSpeed : kWalkSpeed);
    const float ease = 1 - std::exp(-8 * seconds);
    speed_ = mix(speed_, wanted, ease);
    if (strength > 0.1f)
        heading_ += std::remainder(std::atan2(wish.x, wish.z) - heading_, 2 * kPi) * ease;
    walk(headingToDirection(heading_) * speed_, seconds);
    animate(input.is_waving, seconds);
}

void Hero::animate(bool is_waving, float seconds)
{
    const float running = smooth(kWalkSpeed, kRunSpeed, speed_),
                walking = std::fmin(1.0f, speed_ / kWalkSpeed);
    // clips are strides of the character's own length: slow ones are played slowly, and both in step
    const float pace = mix(speed_ / kWalkSpeed, speed_ / kRunSpeed, running);
    stride_ += seconds * pace / static_cast<float>(mix(float(walk_.seconds), float(run_.seconds), running));
    stride_ -= std::floor(stride_);
    waving_ = mix(waving_, is_waving && walking <= 0.05f ? 1.0f : 0.0f, 1 - std::exp(-6 * seconds));
    stood_seconds_ += seconds;

    const auto loop = [](const Clip& clip, double at) {
        return hearth_clip{clip.animation, 0, std::fmod(at, clip.seconds)};
    };
    const hearth_clip idle = loop(idle_, stood_seconds_), wave = loop(wave_, stood_seconds_);
    const hearth_clip walk = loop(walk_, stride_ * walk_.seconds), run = loop(run_, stride_ * run_.seconds);
    std::string why;
    if (running > 0)
        check(player_.goTo(&walk, &run, running, &why), why);
    else if (walking > 0.05f)
        check(player_.goTo(&idle, &walk, walking, &why), why);
    else
        check(player_.goTo(&idle, &wave, waving_, &why), why);
}

void Hero::show(hearth_frame& frame)
{
    // move the poses of the clips, which stay where the source has them, to the place of the hero
    hearth_player_info info = HEARTH_PLAYER_INFO_INIT;
    check(player_.getInfo(info), "");
    poses_.assign(info.poses, info.poses + info.pose_count);
    joints_.clear();
    const double c = std::cos(heading_), s = std::sin(heading_);
    const double world[3][4] = {{c, 0, s, position_.x}, {0, 1, 0, position_.y}, {-s, 0, c, position_.z}};
    for (const hearth_pose& pose : poses_)
        for (uint32_t joint = 0; joint < pose.joint_count; ++joint)
        {
            hearth_transform& moved = joints_.emplace_back();
            for (int row = 0; row < 3; ++row)
                for (int column = 0; column < 4; ++column)
                {
                    moved.m[row][column] = column == 3 ? world[row][3] : 0;
                    for (int k = 0; k < 3; ++k)
                        moved.m[row][column] += world[row][k] * pose.world_from_bind[joint].m[k][column];
                }
        }
    size_t first = 0;
    for (hearth_pose& pose : poses_)
    {
        pose.world_from_bind = &joints_[first];
        first += pose.joint_count;
    }
    frame.poses = poses_.data();
    frame.pose_count = static_cast<uint32_t>(poses_.size());

    // the camera follows behind, nearer where a wall is in between
    const Vec head = position_ + Vec{0, kHead, 0};
    const Vec back =
        headingToDirection(camera_heading_) * -std::cos(camera_tilt_) + Vec{0, std::sin(camera_tilt_), 0};
    const Vec eye = head + back * (castRay(head, back, 3.6f) - 0.2f);
    frame.camera = {{eye.x, eye.y, eye.z}, {head.x, head.y - 0.1f, head.z}, {0, 1, 0}, 0.85f, 0.05f};
}

} // namespace game
