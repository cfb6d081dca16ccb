using System.Collections.Generic;

namespace Lipz
{
    /// <summary>
    /// The position in a clip during playback. Call <see cref="AdvanceTo"/> once per rendered frame with the position
    /// of the audio, handle the due events, and show what the properties return. Each event is due exactly once.
    /// </summary>
    public sealed class ClipCursor
    {
        private const uint Over = 0xFFFFFFFF;
        private const uint Waiting = 0xFFFFFFFE;

        private readonly Clip clip;
        private readonly uint speaker = EventTable.NoName;

        /// <summary>The frame at the position of the audio.</summary>
        private uint frame = Waiting;

        /// <summary>The same for the mouth, which may be ahead of the audio.</summary>
        private uint mouthFrame = Waiting;

        /// <summary>The first segment whose events are not yet due.</summary>
        private int nextSegment;

        /// <summary>Whether all segments that have begun at <c>frame</c> were due.</summary>
        private bool isFired;

        private bool hasLooped;

        internal ClipCursor(Clip clip, string speaker)
        {
            this.clip = clip;
            this.speaker = clip.Bank.Events.NumberOf(speaker);
        }

        /// <summary>Continues at the position of another cursor.</summary>
        internal ClipCursor(Clip clip, string speaker, ClipCursor before)
            : this(clip, speaker)
        {
            LeadUs = before.LeadUs;
            HoldFrames = before.HoldFrames;
            frame = before.frame;
            mouthFrame = before.mouthFrame;
            nextSegment = before.nextSegment;
            isFired = before.isFired;
            hasLooped = before.hasLooped;
        }

        /// <summary>The clip.</summary>
        public Clip Clip
        {
            get { return clip; }
        }

        /// <summary>
        /// How far visemes are ahead of the audio, in microseconds: often one frame, <c>clip.StartOfFrameUs(1)</c>.
        /// </summary>
        public uint LeadUs { get; set; }

        /// <summary>
        /// The least number of frames for which consonants show: <c>clip.HoldFrames()</c>. 0 for none.
        /// </summary>
        public byte HoldFrames { get; set; }

        /// <summary>
        /// Moves to a position of the audio. Returns the segments that have begun since the last call, however long ago
        /// it was. A time before that of the last call makes nothing due, because audio clocks jitter: after a jump of
        /// the audio, call <see cref="Seek"/>.
        /// </summary>
        public DueSegments AdvanceTo(ClipTime time)
        {
            uint before = frame;
            int first = nextSegment;
            Show(time);
            // A display shows most frames several times.
            if (frame != before || !isFired)
            {
                nextSegment = System.Math.Max(first, SegmentsBegun());
                isFired = true;
            }
            return Due(first, nextSegment, 0);
        }

        /// <summary>
        /// Moves to a position of the audio after it has jumped from its end to its start. Returns the remaining
        /// segments, then those from the start on. Call it once per loop.
        /// </summary>
        public DueSegments LoopTo(ClipTime time)
        {
            Show(time);
            int first = nextSegment;
            nextSegment = SegmentsBegun();
            isFired = true;
            hasLooped = true;
            return Due(first, int.MaxValue, nextSegment);
        }

        /// <summary>
        /// Jumps. Nothing is due; the next <see cref="AdvanceTo"/> starts with the segments that begin in this frame.
        /// </summary>
        public void Seek(ClipTime time)
        {
            Show(time);
            // From the end on, that is the last frame.
            uint at = frame == Waiting ? 0 : System.Math.Min(frame, clip.FrameCount);
            nextSegment = at == 0 ? 0 : SegmentsBegunBy(at - 1);
            isFired = false;
            hasLooped = false;
        }

        /// <summary>Ends the clip before the audio ends. Returns the remaining segments.</summary>
        public DueSegments Finish()
        {
            frame = mouthFrame = Over;
            int first = nextSegment;
            nextSegment = clip.SegmentCount;
            isFired = true;
            return Due(first, nextSegment, 0);
        }

        /// <summary>The frame at the position of the audio; null before the start and from the end on.</summary>
        public uint? Frame
        {
            get { return frame == Over || frame == Waiting ? default(uint?) : frame; }
        }

        /// <summary>Whether the audio is past the last frame, so that all events were due.</summary>
        public bool IsOver
        {
            get { return frame == Over; }
        }

        /// <summary>The viseme to show, with lead and hold; rest before the start and from the end on.</summary>
        public char Viseme
        {
            get
            {
                bool isShown = mouthFrame != Over && mouthFrame != Waiting;
                return isShown ? clip.Viseme(ConsonantHold.FrameToShow(clip, HoldFrames, mouthFrame)) : Clip.Rest;
            }
        }

        /// <summary>
        /// How far the mouth to show is open, from 0 to 1; null without frames or without a viseme type: let the mouth
        /// babble.
        /// </summary>
        public float? Openness
        {
            get { return Visemes.OpennessOf(clip, Viseme); }
        }

        /// <summary>The segment whose subtitle to show; null before the start and from the end on.</summary>
        public Segment? Segment
        {
            get { return frame < clip.FrameCount ? clip.Segment(clip.SegmentOfFrame(frame)) : default(Segment?); }
        }

        /// <summary>
        /// Returns the lasting effects of the events so far on a character, or on the speaker. Each call evaluates them
        /// again, so call it after jumps.
        /// </summary>
        public CharacterState State(string character = null)
        {
            uint number = clip.Bank.Events.NumberOf(character);
            if (character != null && number == EventTable.NoName) return new CharacterState(character);
            uint asked = character == null ? speaker : number;
            return CharacterStates.After(Past(), asked, character);
        }

        /// <summary>Returns all characters in the events of the clip: the speaker, then by their names.</summary>
        public List<CharacterState> Characters()
        {
            return CharacterStates.All(Due(0, int.MaxValue, 0), Past(), clip.Bank.Events);
        }

        /// <summary>Returns all segments that were due or jumped over, from the start of the previous loop.</summary>
        private DueSegments Past()
        {
            return Due(0, hasLooped ? int.MaxValue : 0, nextSegment);
        }

        private DueSegments Due(int first, int end, int aroundTo)
        {
            return new DueSegments(clip, speaker, first, end, aroundTo);
        }

        private void Show(ClipTime time)
        {
            frame = FrameAt(time);
            mouthFrame = LeadUs == 0 ? frame : FrameAt(time.Later(LeadUs));
        }

        private uint FrameAt(ClipTime time)
        {
            if (time.TryFrame(clip.Rate, clip.FrameCount, out uint found)) return found;
            return time.HasBegun ? Over : Waiting;
        }

        private int SegmentsBegun()
        {
            if (frame == Waiting) return 0;
            return frame == Over ? clip.SegmentCount : SegmentsBegunBy(frame);
        }

        private int SegmentsBegunBy(uint at)
        {
            return clip.SegmentOfFrame(at) + 1;
        }
    }

    /// <summary>Cursors of a clip.</summary>
    public sealed partial class Clip
    {
        /// <summary>
        /// Returns a cursor that waits for the audio to start; null without a frame rate: set one with
        /// <see cref="OrFps(FrameRate)"/>. Events without a character belong to <paramref name="speaker"/>.
        /// </summary>
        public ClipCursor Cursor(string speaker = null)
        {
            return Rate.IsSpecified ? new ClipCursor(this, speaker) : null;
        }

        /// <summary>
        /// Returns a cursor that continues at the position of another one, whose clip was in an older version of the
        /// bank, with the frame rate and the viseme type that were set on that clip.
        /// </summary>
        public ClipCursor Resume(ClipCursor cursor, string speaker = null)
        {
            return new ClipCursor(OrFps(cursor.Clip.Rate).OrVisemeType(cursor.Clip.VisemeType), speaker, cursor);
        }
    }
}
