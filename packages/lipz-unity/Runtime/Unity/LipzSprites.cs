using System;
using UnityEngine;

namespace Lipz
{
    /// <summary>The sprite of a viseme.</summary>
    [Serializable]
    public struct VisemeSprite
    {
        [SerializeField, Tooltip("The code of the viseme: A, M, ... or - for rest.")]
        private string viseme;

        [SerializeField]
        private Sprite sprite;

        /// <summary>Pairs a sprite with the code of its viseme.</summary>
        public VisemeSprite(char viseme, Sprite sprite)
        {
            this.viseme = viseme.ToString();
            this.sprite = sprite;
        }

        internal bool Has(char code)
        {
            return !string.IsNullOrEmpty(viseme) && viseme[0] == code;
        }

        internal Sprite Sprite
        {
            get { return sprite; }
        }
    }

    /// <summary>Shows a sprite for each viseme.</summary>
    [AddComponentMenu("Lipz/Lipz Sprites")]
    public sealed class LipzSprites : LipzMouth
    {
        [SerializeField]
        private SpriteRenderer mouth;

        [SerializeField]
        private VisemeSprite[] sprites = new VisemeSprite[0];

        private char shown;

        /// <summary>Sets the renderer and the sprites.</summary>
        public void Set(SpriteRenderer spriteRenderer, params VisemeSprite[] visemeSprites)
        {
            mouth = spriteRenderer;
            sprites = visemeSprites;
            shown = '\0';
        }

        /// <inheritdoc/>
        public override void Begin(Clip clip)
        {
            shown = '\0';
        }

        /// <inheritdoc/>
        public override void Show(Clip clip, ClipTime time, char viseme, Who speaker)
        {
            if (viseme == shown || mouth == null) return;
            shown = viseme;
            for (int i = 0; i < sprites.Length; i++)
            {
                if (!sprites[i].Has(viseme)) continue;
                mouth.sprite = sprites[i].Sprite;
                return;
            }
        }

        /// <inheritdoc/>
        public override void Rest()
        {
            Show(null, default(ClipTime), Clip.Rest, default(Who));
        }
    }
}
