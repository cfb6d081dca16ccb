using System.IO;
using Lipz.Editor;
using UnityEditor.AssetImporters;

namespace Lipz.UnityTests
{
    /// <summary>Importers make assets of files, and errors of damaged files.</summary>
    internal static class Importers
    {
        internal static string Check(string fixtures)
        {
            int count = 0;
            foreach (string path in Directory.GetFiles(Path.Combine(fixtures, "banks/v1"), "*.lipzbank"))
            {
                AssetImportContext good = Import(new LipzBankImporter(), path);
                Stage.Equal(0, good.Errors.Count);
                if (((LipzBank)good.mainObject).Bank.ClipCount == 0) throw new System.Exception(path + " is empty");
                count++;
            }
            var split = (LipzBank)Import(new LipzBankImporter(), Stage.PathOf(fixtures, "split")).mainObject;
            string textsPath = Path.Combine(fixtures, "banks/v1/split.de-de.lipztexts");
            var texts = (LipzTexts)Import(new LipzTextsImporter(), textsPath).mainObject;
            split.Add(texts);
            split.Add(texts);
            Stage.Equal("de-de", split.Bank.Locales[0].Tag);

            CheckDamaged(new LipzBankImporter(), Stage.PathOf(fixtures, "small"));
            CheckDamaged(new LipzTextsImporter(), textsPath);
            Stage.Equal("TextsOnly", Import(new LipzBankImporter(), textsPath).Errors[0].Split('(')[1].Split(' ')[0]);
            return count + " banks, 1 text bank, 3 errors";
        }

        /// <summary>A byte inside the file has changed, which only the checksum covers.</summary>
        private static void CheckDamaged(ScriptedImporter importer, string path)
        {
            string damaged = Path.GetTempFileName();
            byte[] bytes = File.ReadAllBytes(path);
            bytes[bytes.Length - 1] ^= 1;
            File.WriteAllBytes(damaged, bytes);
            AssetImportContext bad = Import(importer, damaged);
            File.Delete(damaged);
            Stage.Equal(true, bad.mainObject == null);
            Stage.Equal(
                damaged + ": the checksum does not match: the file was changed or damaged (Checksum at byte 8); "
                    + "copy the file again, or pack it again",
                bad.Errors[0]);
        }

        private static AssetImportContext Import(ScriptedImporter importer, string path)
        {
            var context = new AssetImportContext { assetPath = path };
            importer.OnImportAsset(context);
            return context;
        }
    }
}
