using System.IO;
using UnityEditor.AssetImporters;

namespace Lipz.Editor
{
    /// <summary>Imports <c>.lipztexts</c> files, which are checked when they are added to their bank.</summary>
    [ScriptedImporter(1, "lipztexts")]
    public sealed class LipzTextsImporter : ScriptedImporter
    {
        /// <summary>Makes the asset.</summary>
        public override void OnImportAsset(AssetImportContext context)
        {
            LipzTexts texts = LipzTexts.From(File.ReadAllBytes(context.assetPath));
            context.AddObjectToAsset("texts", texts);
            context.SetMainObject(texts);
        }
    }
}
