using System.IO;
using UnityEditor.AssetImporters;

namespace Lipz.Editor
{
    /// <summary>Imports <c>.lipztexts</c> files. A damaged file is an import error that names the remedy.</summary>
    [ScriptedImporter(1, "lipztexts")]
    public sealed class LipzTextsImporter : ScriptedImporter
    {
        /// <summary>
        /// Checks every byte, and makes the asset. Whether the texts belong to a bank is checked when they are added to
        /// it.
        /// </summary>
        public override void OnImportAsset(AssetImportContext context)
        {
            try
            {
                LipzTexts texts = LipzTexts.From(File.ReadAllBytes(context.assetPath));
                context.AddObjectToAsset("texts", texts);
                context.SetMainObject(texts);
            }
            catch (BankException error)
            {
                context.LogImportError(context.assetPath + ": " + error.Message);
            }
        }
    }
}
