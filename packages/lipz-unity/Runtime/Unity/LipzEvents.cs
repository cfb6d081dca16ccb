using System;
using UnityEngine.Events;

namespace Lipz
{
    /// <summary>Receives the subtitle to show; an empty string to hide it.</summary>
    [Serializable]
    public sealed class SubtitleEvent : UnityEvent<string>
    {
    }

    /// <summary>Receives the character (or an empty string), the verb and the object of an event.</summary>
    [Serializable]
    public sealed class LipzClipEvent : UnityEvent<string, string, string>
    {
    }
}
