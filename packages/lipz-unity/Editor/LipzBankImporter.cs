using System.IO;
using UnityEditor.AssetImporters;

namespace Lipz.Editor
{
    /// <summary>Imports <c>.lipzbank</c> files. A damaged file is an import error that names the remedy.</summary>
    [ScriptedImporter(1, "lipzbank")]
    public sealed class LipzBankImporter : ScriptedImporter
    {
        /// <summary>Checks every byte, and makes the asset.</summary>
        public override void OnImportAsset(AssetImportContext context)
        {
            try
            {
                LipzBank bank = LipzBank.From(File.ReadAllBytes(context.assetPath));
                context.AddObjectToAsset("bank", bank);
                context.SetMainObject(bank);
            }
            catch (BankException error)
            {
                context.LogImportError(context.assetPath + ": " + error.Message);
            }
        }
    }
}
