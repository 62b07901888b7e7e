// The layout of the pages' scripts and styles, and of what checks them.
export default { printWidth: 110 };
