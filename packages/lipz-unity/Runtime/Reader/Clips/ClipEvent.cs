namespace Lipz
{
    /// <summary>What a character does. The numbers are those of the bank format.</summary>
    public enum EventVerb : byte
    {
        /// <summary>Feels an emotion, until the next one.</summary>
        Feels = 1,

        /// <summary>Sees a character or a prop.</summary>
        Sees = 2,

        /// <summary>Stares at a character or a prop, until <see cref="StopsStaring"/>.</summary>
        Stares = 3,

        /// <summary>Stops staring.</summary>
        StopsStaring = 4,

        /// <summary>Points at a character or a prop, until <see cref="StopsPointing"/>.</summary>
        Points = 5,

        /// <summary>Stops pointing.</summary>
        StopsPointing = 6,

        /// <summary>Does an action of your game.</summary>
        Does = 7,

        /// <summary>Nods.</summary>
        Nods = 8,

        /// <summary>Shakes the head.</summary>
        Shakes = 9,

        /// <summary>Breathes hard.</summary>
        Breathes = 10,

        /// <summary>Blinks.</summary>
        Blinks = 11,

        /// <summary>Looks away.</summary>
        LooksAway = 12,
    }

    /// <summary>An event of a clip: <c>mara feels sad</c>.</summary>
    public readonly struct ClipEvent
    {
        private static readonly string[] Verbs =
        {
            "", "feels", "sees", "stares", "stops staring", "points", "stops pointing", "does",
            "nods", "shakes", "breathes", "blinks", "looks away",
        };

        /// <summary>The number of the character's name in the bank.</summary>
        internal readonly uint CharacterNumber;

        /// <summary>The character; null for the speaker, if the cursor has none.</summary>
        public readonly string Character;

        /// <summary>What the character does.</summary>
        public readonly EventVerb Verb;

        /// <summary>The emotion, the target or the action; null if the verb has none.</summary>
        public readonly string Object;

        /// <summary>The verb in Character Event Syntax: <c>stops staring</c>.</summary>
        public string VerbName
        {
            get { return Verbs[(int)Verb]; }
        }

        /// <summary>The strength of a gesture in thousandths; null if it has none.</summary>
        public readonly int? StrengthThousandths;

        internal ClipEvent(uint characterNumber, string character, EventVerb verb, string target, int? strength)
        {
            CharacterNumber = characterNumber;
            Character = character;
            Verb = verb;
            Object = target;
            StrengthThousandths = strength;
        }

        /// <summary>Returns the event in Character Event Syntax.</summary>
        public override string ToString()
        {
            string text = Character == null ? VerbName : Character + " " + VerbName;
            if (Object != null) text += " " + Object;
            return StrengthThousandths == null ? text : text + " " + Thousandths.ToString(StrengthThousandths.Value);
        }
    }
}
