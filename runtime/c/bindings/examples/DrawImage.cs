// DrawImage PACK.hearth OUT.ppm: draws a pack without a window, from its first camera or, if it has none,
// from one that shows the whole scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
using System;
using System.IO;
using System.Runtime.InteropServices;
using System.Text;
using Hearth;

static class DrawImage
{
    const int Width = 640, Height = 480;

    static Camera ChooseCamera(Pack pack, Scene scene)
    {
        if (Api.PackGetCount(pack, Api.TABLE_CAMERAS) > 0)
        {
            PackCamera camera = PackCamera.Default;
            Api.PackGetCamera(pack, 0, ref camera);
            if (camera.type == Api.CAMERA_PERSPECTIVE)
                return camera.view;
        }
        SceneInfo info = SceneInfo.Default;
        Api.SceneGetInfo(scene, ref info);
        return Api.FitCamera(ref info.box_min, ref info.box_max, (float)Width / Height);
    }

    // Draws a frame, and reads its texels: RGBA in sRGB, rows from top to bottom.
    static byte[] DrawFrame(Device device, Renderer renderer, Pack pack, Scene scene)
    {
        TargetsDescription size = TargetsDescription.Default;
        size.width = Width;
        size.height = Height;
        size.scene = scene.Pointer;
        Targets targets = Api.TargetsCreate(renderer, ref size);
        try
        {
            Frame frame = Frame.Default;
            frame.camera = ChooseCamera(pack, scene);
            IntPtr commands = Api.DeviceBegin(device);
            Api.RecordFrame(scene, targets, commands, ref frame);
            Api.DeviceSubmit(device);

            TargetsInfo images = TargetsInfo.Default;
            Api.TargetsGetInfo(targets, ref images);
            byte[] texels = new byte[Width * Height * 4];
            GCHandle pin = GCHandle.Alloc(texels, GCHandleType.Pinned);
            try
            {
                Api.DeviceReadImage(device, ref images.color, Width, Height, pin.AddrOfPinnedObject(),
                    (UIntPtr)texels.Length);
            }
            finally
            {
                pin.Free();
            }
            return texels;
        }
        finally
        {
            Api.TargetsDestroy(targets);
        }
    }

    static byte[] DrawScene(Device device, Renderer renderer, Pack pack)
    {
        SceneOptions options = SceneOptions.Default;
        options.flags = Api.SCENE_DECODE_TEXTURES; // draws packs for phones on any device
        IntPtr commands = Api.DeviceBegin(device);
        Scene scene = Api.SceneUpload(renderer, pack, commands, ref options);
        try
        {
            Api.DeviceSubmit(device);
            Api.SceneReleaseStaging(scene);
            return DrawFrame(device, renderer, pack, scene);
        }
        finally
        {
            Api.SceneDestroy(scene);
        }
    }

    static byte[] Draw(string path)
    {
        Pack pack = null;
        Device device = null;
        Renderer renderer = null;
        try
        {
            pack = Api.PackOpen(path);
            DeviceOptions options = DeviceOptions.Default;
            device = Api.DeviceCreate(ref options);
            RendererDescription description = RendererDescription.Default;
            Api.DeviceDescribe(device, ref description);
            renderer = Api.RendererCreate(ref description);
            return DrawScene(device, renderer, pack);
        }
        finally
        {
            Api.RendererDestroy(renderer); // destroying null does nothing
            Api.DeviceDestroy(device);
            Api.PackClose(pack);
        }
    }

    static int Main(string[] arguments)
    {
        if (arguments.Length != 2)
        {
            Console.Error.WriteLine("usage: DrawImage PACK.hearth OUT.ppm");
            return 1;
        }
        try
        {
            byte[] texels = Draw(arguments[0]);
            using (FileStream file = File.Create(arguments[1]))
            {
                byte[] head = Encoding.ASCII.GetBytes("P6 " + Width + " " + Height + " 255\n");
                file.Write(head, 0, head.Length);
                byte[] colors = new byte[Width * Height * 3];
                for (int i = 0; i < colors.Length; ++i)
                    colors[i] = texels[i / 3 * 4 + i % 3];
                file.Write(colors, 0, colors.Length);
            }
            return 0;
        }
        catch (HearthException error)
        {
            Console.Error.WriteLine("DrawImage: " + error.Message);
            return 1;
        }
    }
}
