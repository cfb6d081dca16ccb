using System;
using System.Collections.Generic;

namespace Lipz
{
    /// <summary>
    /// The shapes of a model: names, and for each a sum of terms of articulation, emotions and face. Projects name
    /// their rigs in <c>[rig]</c> of <c>lipz.toml</c>.
    /// </summary>
    public sealed class Rig : INamed
    {
        private const int RecordBytes = 8;
        private const int WeightBytes = 8;
        private const int TermBytes = 4;
        private const int FirstEmotion = 9;
        private const int FirstOfFace = 21;
        private const int Inputs = 25;
        private const int NoInput = 255;
        private const int MostInput = 4000;
        private const int Whole = 1000;

        private readonly Table weights;
        private readonly Table terms;
        private readonly int[] inputs = new int[Inputs];

        private Rig(string name, string[] weightNames, Table weights, Table terms)
        {
            Name = name;
            WeightNames = weightNames;
            this.weights = weights;
            this.terms = terms;
        }

        /// <summary>The name of the rig: <c>arkit</c>.</summary>
        public string Name { get; private set; }

        /// <summary>The names of the weights, in the order of their values.</summary>
        public IReadOnlyList<string> WeightNames { get; private set; }

        string INamed.LookUpName
        {
            get { return Name; }
        }

        /// <summary>Reads the rigs of a section. A damaged rig ends them.</summary>
        internal static IReadOnlyList<Rig> AllOf(Table section)
        {
            var all = new List<Rig>();
            var pool = new StringPool(section);
            for (long at = 0; at + RecordBytes <= section.Count;)
            {
                long name = at + RecordBytes;
                long first = name + section.U16(at);
                long firstTerm = first + section.U16(at, 2) * WeightBytes;
                long names = firstTerm + section.U16(at, 4) * TermBytes;
                long end = names + section.U16(at, 6);
                if (end > section.Count) break;
                Table weights = section.Part(first, firstTerm).As(WeightBytes);
                var weightNames = new string[weights.Count];
                int nameStart = 0;
                for (int i = 0; i < weightNames.Length; i++)
                {
                    int nameEnd = weights.U16(i, 2);
                    bool isInside = nameStart <= nameEnd && names + nameEnd <= end;
                    weightNames[i] = isInside ? pool.At(names + nameStart, nameEnd - nameStart) ?? "" : "";
                    nameStart = nameEnd;
                }
                Table terms = section.Part(firstTerm, names).As(TermBytes);
                all.Add(new Rig(pool.At(name, first - name) ?? "", weightNames, weights, terms));
                at = end;
            }
            return all;
        }

        /// <summary>
        /// Returns the weights, in the order of <see cref="WeightNames"/>. Without emotions or a face, these are
        /// neutral. To allocate nothing, pass an array to fill, with one element for each name.
        /// </summary>
        public float[] Weights(
            Articulation articulation, Emotions emotions = null, Face face = default(Face), float[] into = null)
        {
            float[] found = into ?? new float[weights.Count];
            Collect(articulation, emotions, face);
            int start = 0;
            for (int i = 0; i < weights.Count && i < found.Length; i++)
            {
                int end = weights.U16(i);
                long sum = 0;
                for (int term = start; term < end && terms.Has(term); term++) sum += Product(term);
                start = end;
                int least = (short)weights.U16(i, 4), most = (short)weights.U16(i, 6);
                found[i] = Math.Min(Math.Max(sum, least), most) / (float)Whole;
            }
            return found;
        }

        /// <summary>Collects the inputs in the order of their numbers, in thousandths.</summary>
        private void Collect(Articulation articulation, Emotions emotions, Face face)
        {
            for (int i = 0; i < FirstEmotion; i++) inputs[i] = articulation.Thousandths[i];
            for (int i = FirstEmotion; i < FirstOfFace; i++)
            {
                inputs[i] = emotions == null ? 0 : Limited(emotions.Thousandths[i - FirstEmotion] / 10);
            }
            inputs[FirstOfFace] = Limited(face.BlinkThousandths);
            inputs[FirstOfFace + 1] = Limited(face.BrowsThousandths);
            inputs[FirstOfFace + 2] = Limited(face.ShrugThousandths);
            inputs[FirstOfFace + 3] = Whole;
        }

        private static int Limited(int input)
        {
            return Math.Max(-MostInput, Math.Min(MostInput, input));
        }

        /// <summary>Returns a term, rounded towards zero. An unknown input is 0.</summary>
        private int Product(int term)
        {
            int first = (short)terms.U16(term) * Input(terms.U8(term, 2)) / Whole;
            int second = terms.U8(term, 3);
            return second == NoInput ? first : first * Input(second) / Whole;
        }

        private int Input(int number)
        {
            return number < Inputs ? inputs[number] : 0;
        }
    }

    /// <summary>The weights of a clip.</summary>
    public sealed partial class Clip
    {
        private Articulation weightArticulation;
        private Emotions weightEmotions;

        /// <summary>
        /// Returns the weights of a rig at a time, with the articulation, the emotions and the face of the speaker. To
        /// allocate nothing, pass an array to fill, with one element for each name.
        /// </summary>
        public float[] WeightsAt(
            ClipTime time, Rig rig, float[] into = null, Who who = default(Who), ArticulationProfile profile = null)
        {
            weightArticulation = ArticulationAt(time, profile, weightArticulation);
            weightEmotions = EmotionsAt(time, who, weightEmotions);
            return rig.Weights(weightArticulation, weightEmotions, FaceAt(time, who), into);
        }
    }
}
