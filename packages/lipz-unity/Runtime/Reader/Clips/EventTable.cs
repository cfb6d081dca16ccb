namespace Lipz
{
    /// <summary>The sections of events: strings, typed events and names.</summary>
    internal sealed class EventTable
    {
        /// <summary>The number of a missing name.</summary>
        internal const uint NoName = 0xFFFFFFFF;

        private readonly Table references;
        private readonly Table records;
        private readonly Table typed;
        private readonly Table names;
        private readonly StringPool strings;

        internal EventTable(BankFile file)
        {
            references = file.Section("EVRF", 4);
            records = file.Section("EVNT", 16);
            typed = file.Section("EVTY", 16);
            names = file.Section("EVNM", 8);
            strings = new StringPool(file.Section("EVST", 1));
        }

        internal bool HasReference(long segment)
        {
            return references.Has(segment);
        }

        /// <summary>Returns the event string of the segment with a number; null if its file has no events.</summary>
        internal string StringOf(long segment)
        {
            long record = RecordOf(segment);
            return record < 0 ? null : strings.At(records.U32(record), records.U32(record, 4));
        }

        /// <summary>Returns the range of the typed events of a segment.</summary>
        internal void TypedOf(long segment, out long first, out long end)
        {
            first = end = 0;
            long record = RecordOf(segment);
            if (record < 0) return;
            first = records.U32(record, 8);
            long behind = first + records.U32(record, 12);
            end = behind <= typed.Count ? behind : first;
        }

        /// <summary>Reads a typed event. Returns false if it is damaged.</summary>
        internal bool TryTyped(long index, uint speaker, out ClipEvent found)
        {
            found = default(ClipEvent);
            uint character = typed.U32(index), target = typed.U32(index, 4);
            byte verb = typed.U8(index, 8);
            if (character != NoName && !names.Has(character)) return false;
            if (verb < (byte)EventVerb.Feels || verb > (byte)EventVerb.LooksAway) return false;
            string name = target == NoName ? null : NameOf(target);
            int? strength = null;
            switch ((EventVerb)verb)
            {
                case EventVerb.Feels:
                case EventVerb.Sees:
                case EventVerb.Stares:
                case EventVerb.Points:
                case EventVerb.Does:
                    if (name == null) return false;
                    break;
                case EventVerb.Nods:
                case EventVerb.Shakes:
                case EventVerb.Breathes:
                    if (target != NoName && !Strengths.TryParse(name, out strength)) return false;
                    name = null;
                    break;
                default:
                    if (target != NoName) return false;
                    break;
            }
            uint of = character == NoName ? speaker : character;
            found = new ClipEvent(of, of == NoName ? null : NameOf(of), (EventVerb)verb, name, strength);
            return true;
        }

        /// <summary>Returns the name with a number; null without it, an empty string if it is damaged.</summary>
        internal string NameOf(uint number)
        {
            return names.Has(number) ? strings.At(names.U32(number), names.U32(number, 4)) ?? "" : null;
        }

        /// <summary>Returns the number of a name; <see cref="NoName"/> if no event and no curve has it.</summary>
        internal uint NumberOf(string name)
        {
            if (name == null) return NoName;
            byte[] wanted = StringPool.BytesOf(name);
            int first = 0, end = names.Count;
            while (first < end)
            {
                int middle = first + (end - first) / 2;
                if (Compare(middle, wanted) < 0) first = middle + 1;
                else end = middle;
            }
            return names.Has(first) && Compare(first, wanted) == 0 ? (uint)first : NoName;
        }

        private int Compare(int number, byte[] name)
        {
            uint start = names.U32(number), length = names.U32(number, 4);
            return strings.Has(start, length) ? strings.Bytes.Compare(start, (int)length, name) : -1;
        }

        /// <summary>Returns the index of the event record of a segment; -1 without it.</summary>
        private long RecordOf(long segment)
        {
            if (!references.Has(segment)) return -1;
            long record = references.U32(segment);
            return records.Has(record) ? record : -1;
        }
    }
}
