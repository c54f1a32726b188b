// CheckRules PACK: checks errors, lifetimes and callbacks of the C# binding; exit code 0 if all hold.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
using System;
using System.Collections.Generic;
using System.Linq;
using System.Runtime.InteropServices;
using System.Threading;
using Hearth;

static class CheckRules
{
    const int Width = 160, Height = 120;

    static void Expect(bool holds, string rule)
    {
        if (!holds)
            throw new Exception(rule);
    }

    static void ExpectError(int result, string part, Action call)
    {
        try
        {
            call();
        }
        catch (HearthException error)
        {
            Expect(error.Result == result && error.Message.Contains(part), error.Message);
            return;
        }
        throw new Exception("a call has not failed: " + part);
    }

    static void CheckPacks(string path)
    {
        ExpectError(Api.ERROR_FILE_MISSING, "no_such_file", () => Api.PackOpen("no_such_file"));
        Pack pack = Api.PackOpen(path);
        Expect(Api.PackGetCount(pack, Api.TABLE_INSTANCES) > 0, "a pack has instances");
        ExpectError(Api.ERROR_USAGE, "", () => Api.PackGetCount(pack, 1000));
        Player player = Api.PlayerCreate(pack);
        Api.PlayerGoTo(player, IntPtr.Zero, IntPtr.Zero, 0);
        ExpectError(Api.ERROR_IN_USE, "1 player", () => Api.PackClose(pack));
        Api.PlayerDestroy(player);
        Api.PackClose(pack);
        Expect(player.Pointer == IntPtr.Zero && pack.Pointer == IntPtr.Zero, "destroyed handles are zero");
        ExpectError(Api.ERROR_USAGE, "", () => Api.PackGetCount(pack, Api.TABLE_NODES));
        try
        {
            Frame.Default.camera.position[3].ToString();
            throw new Exception("an array has no bounds");
        }
        catch (IndexOutOfRangeException)
        {
        }
    }

    // Reads pages, each on a thread of its own. The first read fails.
    sealed class Reader
    {
        public readonly ReadPageCallback Callback; // referenced as long as the scene lives
        public readonly List<Thread> Threads = new List<Thread>();
        readonly Pack pack;

        public Reader(Pack pack)
        {
            this.pack = pack;
            Callback = Start;
        }

        void Start(IntPtr user, uint page, IntPtr destination, UIntPtr size, PageRead read)
        {
            int succeeds = Threads.Count > 0 ? 1 : 0;
            Threads.Add(new Thread(() => Read(page, destination, size, read, succeeds)));
            Threads[Threads.Count - 1].Start();
        }

        void Read(uint page, IntPtr destination, UIntPtr size, PageRead read, int succeeds)
        {
            try
            {
                Api.PackReadPage(pack, page, destination, size);
                Api.ReadDone(read, succeeds);
            }
            catch (HearthException)
            {
                Api.ReadDone(read, 0);
            }
        }
    }

    // Draws frames until one has all pages that it needs, and reads its texels.
    static byte[] Draw(Device device, Renderer renderer, Pack pack, Reader reader)
    {
        SceneOptions options = SceneOptions.Default;
        options.flags = Api.SCENE_DECODE_TEXTURES;
        if (reader != null)
        {
            options.memory_budget = 64 << 20;
            options.read = Marshal.GetFunctionPointerForDelegate(reader.Callback);
        }
        IntPtr commands = Api.DeviceBegin(device);
        Scene scene = Api.SceneUpload(renderer, pack, commands, ref options);
        Api.DeviceSubmit(device);
        ShadowCounters shadows = ShadowCounters.Default;
        ExpectError(Api.ERROR_USAGE, "counters: error: ",
            () => Api.SceneGetShadowCounters(scene, ref shadows));
        TargetsDescription size = TargetsDescription.Default;
        size.width = Width;
        size.height = Height;
        Targets targets = Api.TargetsCreate(renderer, ref size);
        SceneInfo info = SceneInfo.Default;
        Api.SceneGetInfo(scene, ref info);
        Frame frame = Frame.Default;
        frame.camera = Api.FitCamera(ref info.box_min, ref info.box_max, (float)Width / Height);
        frame.error_pixels = 0;
        ulong settled = 0, retried = 0;
        List<int> failed = new List<int>();
        for (ulong serial = 1; settled <= retried && serial < 500; ++serial)
        {
            if (reader != null)
                Api.SceneBeginFrame(scene, serial, serial - 1);
            GC.Collect(); // frees a callback that nothing references
            commands = Api.DeviceBegin(device);
            Api.RecordFrame(scene, targets, commands, ref frame);
            Api.DeviceSubmit(device);
            settled = serial;
            if (reader == null)
                continue;
            StreamCounters counters = StreamCounters.Default;
            Api.SceneGetStreamCounters(scene, ref counters);
            settled = failed.Count > 0 ? counters.settled_serial : 0;
            if (counters.failed_page_count > 0)
            {
                int[] pages = new int[counters.failed_page_count];
                Marshal.Copy(counters.failed_pages, pages, 0, pages.Length);
                failed.AddRange(pages);
                Api.SceneRetryFailed(scene);
                retried = serial;
            }
        }
        Expect(settled > retried, "streaming settles");
        Expect(failed.Count == (reader != null ? 1 : 0), "a failed page is counted once");
        byte[] texels = new byte[Width * Height * 4];
        GCHandle pin = GCHandle.Alloc(texels, GCHandleType.Pinned);
        TargetsInfo images = TargetsInfo.Default;
        Api.TargetsGetInfo(targets, ref images);
        Api.DeviceReadImage(device, ref images.color, Width, Height, pin.AddrOfPinnedObject(),
            (UIntPtr)texels.Length);
        pin.Free();
        if (reader != null)
            reader.Threads.ForEach(thread => thread.Join());
        Api.TargetsDestroy(targets);
        Api.SceneDestroy(scene);
        GC.KeepAlive(reader);
        return texels;
    }

    static int Main(string[] arguments)
    {
        CheckPacks(arguments[0]);
        Pack pack = Api.PackOpen(arguments[0]);
        DeviceOptions options = DeviceOptions.Default;
        Device device = Api.DeviceCreate(ref options);
        RendererDescription description = RendererDescription.Default;
        Api.DeviceDescribe(device, ref description);
        List<string> warnings = new List<string>();
        MessageCallback on_message = (user, message) => warnings.Add(Api.ReadText(message));
        description.message = Marshal.GetFunctionPointerForDelegate(on_message);
        Renderer renderer = Api.RendererCreate(ref description);
        Reader reader = new Reader(pack);
        byte[] streamed = Draw(device, renderer, pack, reader);
        Expect(reader.Threads.Count > 1, "pages are read");
        Expect(warnings.Count == 1 && warnings[0].Contains("page"), "a page that fails is told");
        Expect(streamed.SequenceEqual(Draw(device, renderer, pack, null)), "the streamed frame is the same");
        Api.RendererDestroy(renderer);
        Api.DeviceDestroy(device);
        Api.PackClose(pack);
        GC.KeepAlive(on_message);
        return 0;
    }
}
