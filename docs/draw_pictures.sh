#!/usr/bin/env bash
# Draws the pictures of README and docs, from samples alone. ./dev pictures builds what it needs and calls it.
# Plots of benchmarks are taken from build/bench, where a benchmark has left them.
#   docs/draw_pictures.sh [NAME...]    demo, walk, levels, occlusion, bricks, shadows, lights, lamps, game, view, report, bench, plots
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bin=build/release/bin
work=build/pictures
mkdir -p "$work"

# Generate a sample and cook it, with options of hearth cook.
cooked() { # NAME KIND [OPTION...]
  "$bin/hearth-samples" "$2" -o "$work/$2.glb"
  "$bin/hearth" cook "$work/$2.glb" -o "$work/$1.hearth" -q "${@:3}"
}

draw() { # IMAGE PACK OPTION...
  "$bin/hearth-render" "$work/$2.hearth" -o "$work/$1.png" "${@:3}"
}

# Join images side by side with a gap, and reduce them to a width.
beside() { # PICTURE WIDTH IMAGE...
  convert "${@:3}" -background '#222' -splice 4x0 +append -chop 4x0 -resize "$2x" -strip "docs/$1.png"
}

draw_demo() {
  cooked demo scene --bricks --voxel-size 0.25 --brick-memory 10M
  draw demo demo --scene-camera 0 --size 1280x720 --samples 16
  convert "$work/demo.png" -resize 880x -strip docs/demo.png
}

# The sample game at noon, at dusk and at night.
draw_game() {
  ./dev game --replay runtime/sample_game/camp.inputs --frames 61 --every 20 --size 640x400 -o "$work/game"
  beside game 1200 "$work"/game/00{00,40,60}.png
}

draw_walk() {
  [[ -f $work/demo.hearth ]] || cooked demo scene --bricks --voxel-size 0.25 --brick-memory 10M
  local seconds images=()
  for seconds in 1.1 1.8 2.5 3.2 4.8; do
    draw "walk-$seconds" demo --scene-camera 0 --size 440x400 --animation arrive --time "$seconds"
    images+=("$work/walk-$seconds.png")
  done
  beside walk 1280 "${images[@]}"
}

draw_levels() {
  cooked rock rock
  local error images=()
  for error in 1 4 16 64; do
    draw "levels-$error" rock --fit --size 480x464 --view clusters --error-pixels "$error"
    images+=("$work/levels-$error.png")
  done
  beside levels 1200 "${images[@]}"
}

draw_occlusion() {
  cooked occlusion room --bricks off --visibility-distance 1.5 --visibility-power 1
  draw without occlusion --scene-camera 0 --size 640x360 --ambient-occlusion off --specular-occlusion off
  draw occlusion occlusion --scene-camera 0 --size 640x360 --views final,ao,bent-normal
  convert \( "$work/without.png" "$work/occlusion-final.png" +append \) \
    \( "$work/occlusion-ao.png" "$work/occlusion-bent-normal.png" +append \) -append -strip docs/occlusion.png
}

draw_bricks() {
  cooked bricks room --bricks
  draw without bricks --scene-camera 0 --size 480x270 --gi off
  draw bricks bricks --scene-camera 0 --size 480x270 --views final,bricks
  beside bricks 1448 "$work/without.png" "$work/bricks-final.png" "$work/bricks-bricks.png"
}

draw_shadows() {
  cooked outdoor outdoor
  draw shadows outdoor --scene-camera 0 --size 560x315 --views final,shadow-maps
  beside shadows 1124 "$work/shadows-final.png" "$work/shadows-shadow-maps.png"
}

draw_lights() {
  "$bin/hearth-samples" market --lights 1024 -o "$work/market.glb"
  "$bin/hearth" cook "$work/market.glb" -o "$work/market.hearth" -q
  draw lights market --scene-camera 0 --size 1120x630 --samples 4 --animation evening --time 3 --views final,light-count
  beside lights 1124 "$work/lights-final.png" "$work/lights-light-count.png"
}

# Baked light under four settings of its lamps, and in its texels.
draw_lamps() {
  cooked gallery gallery --receivers --set receivers.texels_per_metre=36
  local name images=() off=(--light pendant_west=0 --light pendant_middle=0 --light pendant_east=0)
  local look=(--scene-camera 0 --size 560x360 --samples 4)
  draw lamps-all gallery "${look[@]}"
  draw lamps-shining gallery "${look[@]}" "${off[@]}" --light spot_stone=0 --light spot_painting=0
  draw lamps-spots gallery "${look[@]}" "${off[@]}" --light neon=0 --light light_box=0 --light sign=0
  draw lamps-texels gallery "${look[@]}" --view receivers
  for name in all shining spots texels; do images+=("$work/lamps-$name.png"); done
  beside lamps 1280 "${images[@]}"
}

# The window with its panel, as a screen shows it.
draw_view() {
  [[ -f $work/demo.hearth ]] || cooked demo scene --bricks --voxel-size 0.25 --brick-memory 10M
  xvfb-run -a -s '-screen 0 900x560x24' bash -c '
    "$0" "$1" --scene-camera 0 --size 900x560 & viewer=$!
    # the screen has one colour until the first frame; 40 seconds later the light of bricks has settled
    until [[ $(import -window root png:- | identify -format %k -) -gt 1000 ]]; do
      kill -0 $viewer || exit 1
      sleep 2
    done
    sleep 40
    import -window root -strip docs/view.png
    kill $viewer' "$bin/hearth-view" "$work/demo.hearth"
}

draw_report() {
  cooked report room --report "$work/report.html"
  chromium --headless --no-sandbox --hide-scrollbars --window-size=1440,2660 --virtual-time-budget=10000 \
    --screenshot="$work/report.png" "file://$PWD/$work/report.html" 2>/dev/null
  convert "$work/report.png" -trim -resize 893x -strip docs/report.png
}

# The field of ./dev bench runtime, if it was cooked.
draw_bench() {
  [[ -f build/bench/field.hearth ]] || { echo "bench: run ./dev bench runtime first"; return; }
  "$bin/hearth-render" build/bench/field.hearth -o docs/bench.png --scene-camera 0 --size 800x450
}

draw_plots() {
  local from to
  while read -r from to; do
    [[ ! -f build/bench/$from ]] || cp "build/bench/$from" "docs/$to"
  done <<'PLOTS'
error.svg error.svg
light.svg light-error.svg
light-room.png light-room.png
PLOTS
}

names=("$@")
((${#names[@]} > 0)) || names=(demo walk levels occlusion bricks shadows lights lamps view report bench plots)
for name in "${names[@]}"; do
  "draw_$name"
  echo "drawn: $name"
done
