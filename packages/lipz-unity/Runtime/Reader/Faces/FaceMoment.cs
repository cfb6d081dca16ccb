using System;

namespace Lipz
{
    /// <summary>Computes the faces of a clip, or of a silent character (guide to faces, "Generated motion").</summary>
    internal sealed class FaceMoment
    {
        private const int Curves = (int)FaceCurve.Pose;
        private const int Neutral = 5000;
        private const int DegreesPerUnit = 2;

        private readonly Clip clip;
        private readonly int?[] values = new int?[Curves];
        private readonly Emotions emotions = new Emotions();
        private readonly Blinks blinks;
        private Curve poses;

        internal FaceMoment(Clip clip)
        {
            this.clip = clip;
            blinks = new Blinks(this);
        }

        internal Face IdleAt(ClipTime time, ulong seed, FaceProfile profile, LookAt look)
        {
            return Made(profile, seed, time.Milliseconds, look, default(Who), new int[3]);
        }

        internal Face FaceAt(ClipTime time, Who who, FaceProfile profile, LookAt look)
        {
            ReadCurves(time, who);
            uint ms = time.Milliseconds;
            bool hasHead = who.IsSpeaker && clip.Rate.IsSpecified && clip.Rate.IsValid;
            ulong seed = who.IsSpeaker ? clip.Id : clip.Id ^ IdOf(who.Name);
            HeadMotion.Read(clip, hasHead, poses, profile, seed, ms, head);
            return Made(profile, seed, ms, look, who, head);
        }

        private readonly int[] head = new int[3];
        private string lastName;
        private ulong lastId;

        /// <summary>Returns the id of a name, which is usually the same as before.</summary>
        private ulong IdOf(string name)
        {
            if (name == lastName) return lastId;
            lastName = name;
            return lastId = ClipIds.IdOf(StringPool.BytesOf(name));
        }

        /// <summary>The strongest emotion at a time; -1 on a calm face.</summary>
        internal int StrongestAt(Who who, long ms)
        {
            if (clip == null) return -1;
            Emotion? strongest = clip.EmotionsAt(ClipTime.Micros(ms * 1000), who, emotions).Strongest;
            return strongest == null ? -1 : (int)strongest.Value;
        }

        private void ReadCurves(ClipTime time, Who who)
        {
            Array.Clear(values, 0, values.Length);
            poses = null;
            foreach (Curve curve in clip.OwnCurves)
            {
                int kind = curve.Purpose.Face;
                if (kind < 0 || !curve.Purpose.BelongsTo(who)) continue;
                if (kind == (int)FaceCurve.Pose)
                {
                    if (poses == null || curve.Name.Length >= poses.Name.Length) poses = curve;
                    continue;
                }
                int? value = curve.ThousandthsAt(time);
                if (value == null) continue;
                bool isSwing = kind == (int)FaceCurve.Nod || kind == (int)FaceCurve.Shake;
                int before = values[kind] ?? value.Value;
                values[kind] = Who.Farther(before, value.Value, isSwing ? Neutral : 0);
            }
        }

        private Face Made(FaceProfile profile, ulong seed, uint ms, LookAt look, Who who, int[] headMotion)
        {
            int blink = values[(int)FaceCurve.Blink] ?? blinks.ClosedAt(profile, seed, ms, who);
            Gaze.Read(profile, seed, ms, look, out int eyePitch, out int eyeYaw);
            int pitch = profile.Shared(Sum(FaceCurve.EyePitch, eyePitch, FaceCurve.LookPitch), out int headPitch);
            int yaw = profile.Shared(Sum(FaceCurve.EyeYaw, eyeYaw, FaceCurve.LookYaw), out int headYaw);
            return new Face
            {
                BlinkThousandths = Math.Max(blink, OrZero(FaceCurve.Lids)),
                HeadPitchThousandths = Turned(FaceCurve.HeadPitch, headMotion[0], Swing(FaceCurve.Nod) + headPitch),
                HeadYawThousandths = Turned(FaceCurve.HeadYaw, headMotion[1], Swing(FaceCurve.Shake) + headYaw),
                HeadRollThousandths = Turned(FaceCurve.HeadRoll, headMotion[2], 0),
                EyePitchThousandths = pitch,
                EyeYawThousandths = yaw,
                BrowsThousandths = OrZero(FaceCurve.Brows),
                ShrugThousandths = OrZero(FaceCurve.Shrug),
                BreathThousandths = OrZero(FaceCurve.Breath),
            };
        }

        private int OrZero(FaceCurve curve)
        {
            return values[(int)curve] ?? 0;
        }

        private long Sum(FaceCurve whole, int generated, FaceCurve more)
        {
            return (long)(values[(int)whole] ?? generated) + OrZero(more);
        }

        /// <summary>Returns the degrees of a curve that is neutral at 5.</summary>
        private long Swing(FaceCurve curve)
        {
            return ((long)(values[(int)curve] ?? Neutral) - Neutral) * DegreesPerUnit;
        }

        private int Turned(FaceCurve whole, int generated, long more)
        {
            return Chance.Limited((values[(int)whole] ?? generated) + more, int.MaxValue);
        }
    }
}
