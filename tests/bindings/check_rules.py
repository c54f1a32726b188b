# SPDX-License-Identifier: LicenseRef-Hearth-Undecided
"""check_rules.py PACK: check errors, lifetimes and callbacks of hearth.py; prints nothing if all hold."""
import ctypes
import sys
import threading

import hearth

WIDTH, HEIGHT = 160, 120


def expect_error(result, part, call, *arguments):
    try:
        call(*arguments)
    except hearth.Error as error:
        assert error.result == result and part in str(error), (error.result, str(error))
        assert "\n" not in str(error), str(error)
    else:
        raise AssertionError(f"{call.__name__} has not failed")


def check_packs(path):
    expect_error(hearth.ERROR_FILE_MISSING, "no_such_file", hearth.pack_open, "no_such_file")
    pack = hearth.pack_open(path)
    assert hearth.pack_get_count(pack, hearth.TABLE_INSTANCES) > 0
    expect_error(hearth.ERROR_USAGE, "", hearth.pack_get_count, pack, 1000)
    name = hearth.pack_get_name(pack, hearth.TABLE_NODES, 0)
    assert len(name.text[:name.length]) == name.length
    player = hearth.player_create(pack)
    hearth.player_go_to(player, None, None, 0)
    expect_error(hearth.ERROR_IN_USE, "1 player", hearth.pack_close, pack)
    try:
        hearth.pack_close(player)
    except ctypes.ArgumentError as error:
        assert "expected Pack, not Player" in str(error)
    else:
        raise AssertionError("a player was taken for a pack")
    hearth.player_destroy(player)
    hearth.pack_close(pack)
    assert not player and not pack
    expect_error(hearth.ERROR_USAGE, "", hearth.pack_get_count, pack, hearth.TABLE_NODES)
    try:
        hearth.Frame(camra=0)
    except AttributeError:
        pass
    else:
        raise AssertionError("a field that is none was set")


class Reader:
    """Reads pages, each on a thread of its own. The first read fails."""

    def __init__(self, pack):
        self.pack, self.threads, self.errors = pack, [], []
        self.callback = hearth.ReadPageCallback(self.start)  # lives as long as the scene

    def start(self, user, page, destination, size, read):
        succeeds = 1 if self.threads else 0
        arguments = (page, destination, size, read, succeeds)
        self.threads.append(threading.Thread(target=self.read, args=arguments))
        self.threads[-1].start()

    def read(self, page, destination, size, read, succeeds):
        try:
            hearth.pack_read_page(self.pack, page, destination, size)
            hearth.read_done(read, succeeds)
        except hearth.Error as error:
            self.errors.append(error)
            hearth.read_done(read, 0)


def draw(device, renderer, pack, reader=None):
    """Draw all triangles, with a reader until all pages are there; return the texels."""
    options = hearth.SceneOptions(flags=hearth.SCENE_DECODE_TEXTURES)
    if reader is not None:
        options.memory_budget, options.read = 64 << 20, reader.callback
    commands = hearth.device_begin(device)
    scene = hearth.scene_upload(renderer, pack, commands, options)
    hearth.device_submit(device)
    expect_error(hearth.ERROR_USAGE, "counters: error: ", hearth.scene_get_shadow_counters, scene)
    targets = hearth.targets_create(renderer, hearth.TargetsDescription(width=WIDTH, height=HEIGHT))
    info = hearth.scene_get_info(scene)
    frame = hearth.Frame(camera=hearth.fit_camera(info.box_min, info.box_max, WIDTH / HEIGHT), error_pixels=0)
    serial, settled, retried, failed = 0, 0, 0, []
    while settled <= retried and serial < 500:
        serial += 1
        if reader is not None:
            hearth.scene_begin_frame(scene, serial, serial - 1)
        commands = hearth.device_begin(device)
        hearth.record_frame(scene, targets, commands, frame)
        hearth.device_submit(device)
        settled = serial
        if reader is not None:
            counters = hearth.scene_get_stream_counters(scene)
            settled = counters.settled_serial if failed else 0
            if counters.failed_page_count > 0:
                failed += counters.failed_pages[:counters.failed_page_count]
                hearth.scene_retry_failed(scene)
                retried = serial
    assert settled > retried and len(failed) == (0 if reader is None else 1), (settled, retried, failed)
    texels = ctypes.create_string_buffer(WIDTH * HEIGHT * 4)
    image = hearth.targets_get_info(targets).color
    hearth.device_read_image(device, image, WIDTH, HEIGHT, texels, len(texels))
    for thread in reader.threads if reader is not None else ():
        thread.join()
    hearth.targets_destroy(targets)
    hearth.scene_destroy(scene)
    return texels.raw


check_packs(sys.argv[1])
pack = hearth.pack_open(sys.argv[1])
device = hearth.device_create(hearth.DeviceOptions())
warnings = []
on_message = hearth.MessageCallback(lambda user, message: warnings.append(message.decode()))
description = hearth.RendererDescription(message=on_message)
renderer = hearth.renderer_create(hearth.device_describe(device, description))
reader = Reader(pack)
streamed = draw(device, renderer, pack, reader)
assert len(reader.threads) > 1 and not reader.errors, reader.errors
assert len(warnings) == 1 and "page" in warnings[0], warnings
assert streamed == draw(device, renderer, pack), "the streamed frame is another"
hearth.renderer_destroy(renderer)
hearth.device_destroy(device)
hearth.pack_close(pack)
