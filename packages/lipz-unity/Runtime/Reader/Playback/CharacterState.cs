using System.Collections.Generic;

namespace Lipz
{
    /// <summary>
    /// The lasting effects of a character's events (Lipz specification, "Character Event Syntax"). A property is null
    /// if no event has set it.
    /// </summary>
    public struct CharacterState
    {
        /// <summary>The character; null for a speaker without a name.</summary>
        public readonly string Name;

        internal CharacterState(string name)
        {
            Name = name;
            Feels = StaresAt = PointsAt = null;
        }

        /// <summary>The emotion.</summary>
        public string Feels { get; private set; }

        /// <summary>The target of the character's stare.</summary>
        public string StaresAt { get; private set; }

        /// <summary>The target at which the character points.</summary>
        public string PointsAt { get; private set; }

        /// <summary>Applies an event of this character.</summary>
        public void Apply(ClipEvent happened)
        {
            switch (happened.Verb)
            {
                case EventVerb.Feels: Feels = happened.Object; break;
                case EventVerb.Stares: StaresAt = happened.Object; break;
                case EventVerb.StopsStaring: StaresAt = null; break;
                case EventVerb.Points: PointsAt = happened.Object; break;
                case EventVerb.StopsPointing: PointsAt = null; break;
            }
        }
    }

    internal static class CharacterStates
    {
        /// <summary>
        /// The most segments and events that one query evaluates: thousands of segments of a forged bank can share one
        /// string of thousands of events.
        /// </summary>
        private const int MostSteps = 1 << 20;

        /// <summary>Returns the state of the character with a number after the events of segments.</summary>
        internal static CharacterState After(DueSegments segments, uint character, string name)
        {
            var state = new CharacterState(name);
            int steps = 0;
            foreach (Segment segment in segments)
            {
                if (++steps > MostSteps) return state;
                foreach (ClipEvent happened in segments.EventsOf(segment))
                {
                    if (++steps > MostSteps) return state;
                    if (happened.CharacterNumber == character) state.Apply(happened);
                }
            }
            return state;
        }

        /// <summary>Returns every character of <paramref name="all"/>, after the events of other segments.</summary>
        internal static List<CharacterState> All(DueSegments all, DueSegments past, EventTable events)
        {
            // The speaker without a name comes first.
            var numbers = new SortedSet<long>();
            int steps = 0;
            foreach (Segment segment in all)
            {
                if (++steps > MostSteps) break;
                foreach (ClipEvent happened in all.EventsOf(segment))
                {
                    if (++steps > MostSteps) break;
                    numbers.Add(happened.CharacterNumber == EventTable.NoName ? -1L : happened.CharacterNumber);
                }
            }
            var states = new List<CharacterState>(numbers.Count);
            foreach (long number in numbers)
            {
                uint character = number < 0 ? EventTable.NoName : (uint)number;
                states.Add(After(past, character, events.NameOf(character)));
            }
            return states;
        }
    }
}
