using System.Linq;
using UnityEngine;

namespace Lipz.UnityTests
{
    /// <summary>Blend shapes of known and unknown names, and sprites.</summary>
    internal static class Mouths
    {
        internal static string Check(string fixtures)
        {
            // Without the names of a rig's weights: a shape for each viseme.
            var stage = new Stage(Stage.PathOf(fixtures, "drama"), "Basis", "Mouth_A", "Mouth_E", "Mouth_O", "Mouth_S");
            stage.Play(24000, "act1/mara-good-evening");
            stage.Tick(4000);
            Stage.Equal("0 0 0 100 0", stage.Shown());
            string[] missing = { "none of 1 shapes", "no rig for these shapes: add arkit = true to [rig]" };
            for (int i = 0; i < missing.Length; i++)
            {
                Debug.Warnings.Clear();
                stage = new Stage(Stage.PathOf(fixtures, "drama"), i == 0 ? "Smile" : "jawOpen");
                stage.Play(24000, "act1/mara-good-evening");
                stage.Tick(2000);
                Stage.Equal(true, Debug.Warnings.Single().Contains(missing[i]));
            }
            return Sprites(fixtures);
        }

        private static string Sprites(string fixtures)
        {
            var stage = new Stage(Stage.PathOf(fixtures, "drama"), "Mouth_A");
            var mouth = stage.Player.gameObject.AddComponent<SpriteRenderer>();
            Sprite rest = new Sprite(), open = new Sprite();
            stage.Player.gameObject.AddComponent<LipzSprites>().Set(
                mouth, new VisemeSprite('-', rest), new VisemeSprite('O', open), new VisemeSprite('S', rest));
            stage.Play(24000, "act1/mara-good-evening");
            stage.Tick(4000);
            Stage.Equal(true, mouth.sprite == open);
            stage.Source.Pause();
            stage.Tick(0);
            Stage.Equal(true, mouth.sprite == rest);
            return "visemes, warnings, sprites";
        }
    }
}
