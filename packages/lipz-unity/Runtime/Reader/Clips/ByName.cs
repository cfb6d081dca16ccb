using System.Collections.Generic;

namespace Lipz
{
    /// <summary>A part of a bank that a program looks up by its name.</summary>
    internal interface INamed
    {
        string LookUpName { get; }
    }

    internal static class ByName
    {
        /// <summary>Returns the first part with a name; null without it.</summary>
        internal static T Find<T>(IReadOnlyList<T> parts, string name)
            where T : class, INamed
        {
            for (int i = 0; i < parts.Count; i++)
            {
                if (parts[i].LookUpName == name) return parts[i];
            }
            return null;
        }
    }
}
