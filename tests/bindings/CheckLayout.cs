// CheckLayout TABLE: compares the C# binding with a table of the C compiler; prints each difference.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
using System;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;

static class CheckLayout
{
    static string JoinWords(string name)
    {
        string plain = name.StartsWith("hearth_") ? name.Substring(7) : name;
        var words = plain.Split('_').Select(word => char.ToUpperInvariant(word[0]) + word.Substring(1));
        return string.Concat(words);
    }

    static Type FindStruct(string name)
    {
        return typeof(Hearth.Api).Assembly.GetType("Hearth." + JoinWords(name), true);
    }

    static string ReadDefault(Type type)
    {
        object value = type.GetProperty("Default").GetValue(null);
        byte[] bytes = new byte[Marshal.SizeOf(type)];
        GCHandle pin = GCHandle.Alloc(bytes, GCHandleType.Pinned);
        Marshal.StructureToPtr(value, pin.AddrOfPinnedObject(), false);
        pin.Free();
        return BitConverter.ToString(bytes).Replace("-", "").ToLowerInvariant();
    }

    static string Find(string kind, string name)
    {
        Type api = typeof(Hearth.Api);
        switch (kind)
        {
            case "constant": return api.GetField(name.Substring(7)).GetRawConstantValue().ToString();
            case "function": return api.GetMethods().Any(m => m.Name == JoinWords(name)) ? "" : "missing";
            case "default": return ReadDefault(FindStruct(name));
            case "struct": return Marshal.SizeOf(FindStruct(name)).ToString();
        }
        string[] words = name.Split('.');
        Type type = FindStruct(words[0]);
        FieldInfo field = type.GetField(words[1]);
        return Marshal.OffsetOf(type, words[1]) + " " + Marshal.SizeOf(field.FieldType);
    }

    static void Main(string[] arguments)
    {
        foreach (string line in File.ReadLines(arguments[0]))
        {
            string[] words = line.Split(new[] {' '}, 3);
            string found = Find(words[0], words[1]);
            if (found != (words.Length > 2 ? words[2] : ""))
                Console.WriteLine(line + ": " + found);
        }
    }
}
