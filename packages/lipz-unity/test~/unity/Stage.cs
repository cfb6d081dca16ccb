using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using UnityEngine;

namespace Lipz.UnityTests
{
    /// <summary>A character with a player, an audio source and a mesh, and a record of what happens.</summary>
    internal sealed class Stage
    {
        internal const int OutputRateHz = 48000;
        internal const string Key = "spoken";

        internal readonly LipzBank Bank;
        internal readonly LipzPlayer Player;
        internal readonly AudioSource Source;
        internal readonly SkinnedMeshRenderer Face;
        internal readonly List<string> Happened = new List<string>();
        private readonly Action lateUpdate;

        internal Stage(string bankPath, params string[] shapes)
            : this(bankPath, true, shapes)
        {
        }

        internal Stage(string bankPath, bool records, params string[] shapes)
        {
            Bank = LipzBank.From(File.ReadAllBytes(bankPath));
            var character = new GameObject("Mara");
            Face = character.AddComponent<SkinnedMeshRenderer>();
            Face.sharedMesh = MeshWith(shapes.Length > 0 ? shapes : Bank.Bank.Rig("arkit").WeightNames.ToArray());
            character.AddComponent<LipzBlendShapes>().Face = Face;
            Player = character.AddComponent<LipzPlayer>();
            Player.BankAsset = Bank;
            Player.AudioSource = Source = character.AddComponent<AudioSource>();
            lateUpdate = Message("LateUpdate");
            if (!records) return;
            Player.OnSubtitle.AddListener(text => Happened.Add("\"" + text + "\""));
            Player.OnEvent.AddListener((who, verb, target) => Happened.Add((who + " " + verb + " " + target).Trim()));
            Player.OnFinished.AddListener(() => Happened.Add("finished"));
        }

        internal static Mesh MeshWith(params string[] shapes)
        {
            var mesh = new Mesh();
            foreach (string shape in shapes) mesh.AddBlendShapeFrame(shape, 100, new Vector3[0], null, null);
            return mesh;
        }

        internal Action Message(string name)
        {
            return Message(Player, name);
        }

        /// <summary>A method that the engine calls by its name.</summary>
        internal static Action Message(MonoBehaviour component, string name)
        {
            MethodInfo method = component.GetType().GetMethod(name, BindingFlags.Instance | BindingFlags.NonPublic);
            return (Action)Delegate.CreateDelegate(typeof(Action), component, method);
        }

        /// <summary>Starts a clip with a silent recording of its length, in samples per second.</summary>
        internal AudioClip Play(int rateHz, string key = Key)
        {
            int samples = (int)(Bank.Bank.Clip(key).DurationUs.Value * (ulong)rateHz / 1000000);
            AudioClip recording = AudioClip.Create(key, samples, 1, rateHz, false);
            if (!Player.Play(key, recording)) throw new Exception("the clip does not play");
            return recording;
        }

        /// <summary>Renders a frame after this many samples of the output.</summary>
        internal void Tick(int outputSamples)
        {
            Source.Output(outputSamples, OutputRateHz);
            lateUpdate();
        }

        /// <summary>The weights of all shapes, in whole numbers.</summary>
        internal string Shown()
        {
            var weights = Enumerable.Range(0, Face.sharedMesh.blendShapeCount).Select(Face.GetBlendShapeWeight);
            return string.Join(" ", weights.Select(weight => Math.Round(weight)));
        }

        internal bool IsAtRest
        {
            get { return Shown().Replace("0", "").Trim() == ""; }
        }

        internal static string PathOf(string fixtures, string name)
        {
            return Path.Combine(fixtures, "banks/v1/" + name + ".lipzbank");
        }

        internal static void Equal(object expected, object found)
        {
            if (!expected.Equals(found)) throw new Exception("found    " + found + "\n    expected " + expected);
        }
    }
}
